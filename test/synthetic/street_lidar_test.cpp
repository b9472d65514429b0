// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_lidar.h"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "synthetic/test_street.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using testing::short_street;

class StreetLidarTest : public ::testing::Test {
 protected:
  StreetLidarTest()
      : raycaster_(short_street()),
        map_from_velo_(short_street().trajectory[5].map_from_left *
                       kitti_rig(false).left_from_velo) {
    config_.beams = 16;
    config_.azimuth_step_deg = 0.5;
  }

  std::vector<Eigen::Vector4f> scan(std::uint64_t seed = 1) const {
    return scan_street(short_street(), raycaster_, map_from_velo_, config_, seed);
  }

  StreetRaycaster raycaster_;
  Eigen::Isometry3d map_from_velo_;
  StreetLidarConfig config_;
};

TEST_F(StreetLidarTest, ExactPointsLieOnTheMesh) {
  config_.range_sigma_m = 0.0;
  const auto points = scan();
  ASSERT_GT(points.size(), 2000U);
  for (const Eigen::Vector4f& p : points) {
    EXPECT_LT(raycaster_.distance(map_from_velo_ * p.head<3>().cast<double>()), 2e-5);
  }
}

TEST_F(StreetLidarTest, RangeNoiseHasTheStatedDeviation) {
  const auto points = scan();
  double sum = 0.0;
  double squares = 0.0;
  for (const Eigen::Vector4f& p : points) {
    const Eigen::Vector3d in_velo = p.head<3>().cast<double>();
    EXPECT_LT(raycaster_.distance(map_from_velo_ * in_velo), 6.0 * config_.range_sigma_m);
    const auto hit = raycaster_.cast(map_from_velo_.translation(),
                                     map_from_velo_.linear() * in_velo.normalized());
    ASSERT_TRUE(hit.has_value());
    // A point rounded to float may, at a silhouette, slip to the surface behind.
    const double error = in_velo.norm() - hit->distance;
    if (std::abs(error) < 0.2) {
      sum += error;
      squares += error * error;
    }
  }
  const auto count = static_cast<double>(points.size());
  EXPECT_NEAR(sum / count, 0.0, 0.002);
  EXPECT_NEAR(std::sqrt(squares / count), config_.range_sigma_m, 0.002);
}

TEST_F(StreetLidarTest, StaysInItsSectorBeamsAndRange) {
  config_.max_range_m = 20.0;
  std::set<int> elevations;
  for (const Eigen::Vector4f& p : scan()) {
    const double azimuth = std::atan2(p.y(), p.x()) * 180.0 / M_PI;
    EXPECT_LE(std::abs(azimuth), config_.half_sector_deg + 1e-3);
    EXPECT_LT(p.head<3>().norm(), 20.2F);
    EXPECT_GE(p.w(), 0.0F);
    EXPECT_LE(p.w(), 1.0F);
    elevations.insert(
        static_cast<int>(std::lround(10.0 * std::atan2(p.z(), p.head<2>().norm()) * 180.0 / M_PI)));
  }
  EXPECT_LE(elevations.size(), 16U);
}

TEST_F(StreetLidarTest, SameSeedSameScan) {
  EXPECT_EQ(scan(4), scan(4));
  EXPECT_NE(scan(4), scan(5));
}

TEST_F(StreetLidarTest, DropoutDropsTheStatedShare) {
  config_.dropout = 0.0;
  config_.glass_dropout = 0.0;
  const auto all = static_cast<double>(scan().size());
  config_.dropout = 0.3;
  EXPECT_NEAR(static_cast<double>(scan().size()) / all, 0.7, 0.03);
  config_.dropout = 1.0;
  EXPECT_TRUE(scan().empty());
}

TEST_F(StreetLidarTest, RefusesNonsense) {
  config_.beams = 0;
  EXPECT_THROW(scan(), std::invalid_argument);
  config_.beams = 16;
  config_.azimuth_step_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(scan(), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
