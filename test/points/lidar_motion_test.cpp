// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A moving sensor sweeps over a wall; what it saw at one instant is flat again.
#include "facet_mapping/points/lidar_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {
namespace {

constexpr double kWallX = 20.0;  // metres, of the world
constexpr double kStamp = 1e9 + 0.5;
constexpr double kScanS = 0.1;

/// Straight on with a turn to the left, x forward.
Eigen::Isometry3d world_from_sensor(double stamp, double speed, double turn) {
  const double t = stamp - kStamp;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(turn * t, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(1e4 + speed * t, 2e4, 1.7);
  return pose;
}

SensorPath path_of(double speed, double turn, double margin_s = 0.01) {
  std::vector<StampedPose> poses;
  for (double t = -margin_s; t < kScanS + margin_s + 0.005; t += 0.01) {
    poses.push_back({kStamp + t, world_from_sensor(kStamp + t, speed, turn)});
  }
  return SensorPath(std::move(poses));
}

/// Points of the wall, each as the sensor sees it at its time; in a random order.
LidarScan sweep_wall(double speed, double turn, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  LidarScan scan;
  scan.stamp = kStamp;
  constexpr int kCount = 1500;
  for (int i = 0; i < kCount; ++i) {
    scan.offsets_s.push_back(kScanS * i / (kCount - 1));
  }
  std::shuffle(scan.offsets_s.begin(), scan.offsets_s.end(), random);
  for (const double offset : scan.offsets_s) {
    const Eigen::Vector3d world(1e4 + kWallX, 2e4 + place(random), 1.7 + place(random));
    const Eigen::Isometry3d pose = world_from_sensor(kStamp + offset, speed, turn);
    scan.points.emplace_back((pose.inverse(Eigen::Isometry) * world).cast<float>());
  }
  return scan;
}

/// Largest distance from the wall of points that were all seen from `pose`.
double worst_distance(const std::vector<Eigen::Vector3f>& points, const Eigen::Isometry3d& pose) {
  double worst = 0.0;
  for (const Eigen::Vector3f& point : points) {
    worst = std::max(worst, std::abs((pose * point.cast<double>()).x() - 1e4 - kWallX));
  }
  return worst;
}

struct Motion {
  double speed;  // metres per second
  double turn;   // radians per second
};

class MovingSensor : public testing::TestWithParam<Motion> {};

TEST_P(MovingSensor, WallIsFlatAfterCompensationOnly) {
  const auto [speed, turn] = GetParam();
  const LidarScan scan = sweep_wall(speed, turn);
  MotionReport report;
  const auto parts = compensate_motion(scan, path_of(speed, turn), 0.0, &report);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].stamp, kStamp);
  EXPECT_EQ(parts[0].points.size(), scan.points.size());
  EXPECT_LT(worst_distance(parts[0].points, parts[0].world_from_sensor), 2e-3);
  EXPECT_GT(worst_distance(scan.points, parts[0].world_from_sensor), 0.1);
  EXPECT_NEAR(report.moved_m, std::abs(speed) * kScanS, 1e-6);
  EXPECT_NEAR(report.seconds, kScanS, 1e-6);
  EXPECT_EQ(report.without_time, 0U);
}

TEST_P(MovingSensor, PartsAreFlatAndNearTheirOrigins) {
  const auto [speed, turn] = GetParam();
  const LidarScan scan = sweep_wall(speed, turn, 2);
  constexpr double kSplitM = 0.4;
  const auto parts = compensate_motion(scan, path_of(speed, turn), kSplitM);
  EXPECT_EQ(parts.size(), std::max(1.0, std::ceil(std::abs(speed) * kScanS / kSplitM - 1e-6)));
  std::size_t points = 0;
  for (const CompensatedScan& part : parts) {
    points += part.points.size();
    EXPECT_LT(worst_distance(part.points, part.world_from_sensor), 2e-3);
    EXPECT_LT(
        (part.world_from_sensor.matrix() - world_from_sensor(part.stamp, speed, turn).matrix())
            .norm(),
        1e-3);
  }
  EXPECT_EQ(points, scan.points.size());
  for (std::size_t k = 1; k < parts.size(); ++k) {
    EXPECT_GT(parts[k].stamp, parts[k - 1].stamp);
    // Far enough for a map that takes a frame each kSplitM / 2, near enough for honest rays.
    const double apart =
        (parts[k].world_from_sensor.translation() - parts[k - 1].world_from_sensor.translation())
            .norm();
    EXPECT_GE(apart, 0.5 * kSplitM);
    EXPECT_LE(apart, kSplitM + 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Motions,
    MovingSensor,
    testing::Values(Motion{15.0, 0.0}, Motion{-3.0, 0.0}, Motion{0.0, 1.0}, Motion{30.0, -0.8}));

TEST(CompensateMotion, StandingStillChangesNothing) {
  const LidarScan scan = sweep_wall(0.0, 0.0);
  const auto parts = compensate_motion(scan, path_of(0.0, 0.0), 0.1);
  ASSERT_EQ(parts.size(), 1U);
  ASSERT_EQ(parts[0].points.size(), scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    EXPECT_LT((parts[0].points[i] - scan.points[i]).norm(), 2e-6F);
  }
}

TEST(CompensateMotion, WithoutTimesTheScanIsOfItsStamp) {
  LidarScan scan = sweep_wall(15.0, 0.0);
  scan.offsets_s.clear();
  const SensorPath path({{kStamp, world_from_sensor(kStamp, 15.0, 0.0)}});
  const auto parts = compensate_motion(scan, path, 0.1);
  ASSERT_EQ(parts.size(), 1U);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    EXPECT_LT((parts[0].points[i] - scan.points[i]).norm(), 1e-5F);
  }
  EXPECT_TRUE(compensate_motion({kStamp, {}, {}}, path).empty());
}

TEST(CompensateMotion, PointsOfUnknownTimeAreDroppedAndCounted) {
  LidarScan scan = sweep_wall(15.0, 0.0);
  scan.offsets_s[3] = std::numeric_limits<double>::quiet_NaN();
  scan.offsets_s[7] = std::numeric_limits<double>::infinity();
  MotionReport report;
  const auto parts = compensate_motion(scan, path_of(15.0, 0.0), 0.0, &report);
  EXPECT_EQ(report.without_time, 2U);
  EXPECT_EQ(parts.at(0).points.size(), scan.points.size() - 2);
  std::fill(scan.offsets_s.begin(), scan.offsets_s.end(), std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(compensate_motion(scan, path_of(15.0, 0.0), 0.0, &report).empty());
  EXPECT_EQ(report.without_time, scan.points.size());
}

TEST(CompensateMotion, RefusesScansBeyondThePoses) {
  const LidarScan scan = sweep_wall(15.0, 0.0);
  const auto cut_path = [](double first, double last) {
    std::vector<StampedPose> poses;
    for (int i = 0; i <= 20; ++i) {
      const double stamp = kStamp + first + (last - first) * i / 20.0;
      poses.push_back({stamp, world_from_sensor(stamp, 15.0, 0.0)});
    }
    return SensorPath(std::move(poses), 0.02);
  };
  EXPECT_NO_THROW(compensate_motion(scan, cut_path(0.0, 0.1)));
  EXPECT_NO_THROW(compensate_motion(scan, cut_path(0.015, 0.085)));  // a little extrapolation
  EXPECT_THROW(compensate_motion(scan, cut_path(0.03, 0.2)), std::invalid_argument);
  EXPECT_THROW(compensate_motion(scan, cut_path(-0.1, 0.07)), std::invalid_argument);
  EXPECT_THROW(compensate_motion(scan, cut_path(0.2, 0.3)), std::invalid_argument);
  try {
    compensate_motion(scan, cut_path(-0.1, 0.07));
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("poses"), std::string::npos);
  }
  LidarScan uneven = scan;
  uneven.offsets_s.pop_back();
  EXPECT_THROW(compensate_motion(uneven, cut_path(0.0, 0.1)), std::invalid_argument);
}

TEST(SensorPath, InterpolatesExtrapolatesALittleAndRefusesTheRest) {
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear() = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  turned.translation() = Eigen::Vector3d(0.0, 0.0, 2.0);
  const SensorPath path({{10.0, Eigen::Isometry3d::Identity()}, {10.1, turned}}, 0.02, 0.2);
  const auto expect_at = [&](double stamp, double share) {
    const auto pose = path.at(stamp);
    ASSERT_TRUE(pose.has_value()) << stamp;
    EXPECT_NEAR(pose->translation().z(), 2.0 * share, 1e-9);
    EXPECT_LT((pose->linear() -
               Eigen::AngleAxisd(0.2 * share, Eigen::Vector3d::UnitY()).toRotationMatrix())
                  .norm(),
              1e-9);
    EXPECT_TRUE(is_rigid(*pose));
  };
  for (const double share : {-0.19, 0.0, 0.3, 0.5, 1.0, 1.19}) {
    expect_at(10.0 + 0.1 * share, share);
  }
  EXPECT_FALSE(path.at(9.97).has_value());
  EXPECT_FALSE(path.at(10.13).has_value());
  EXPECT_FALSE(path.at(std::numeric_limits<double>::quiet_NaN()).has_value());
  EXPECT_NEAR(path.way_m(10.05), 1.0, 1e-9);
  EXPECT_NEAR(path.stamp_at(1.0), 10.05, 1e-9);
}

TEST(SensorPath, DoesNotBridgeGapsNorGuessFromOnePose) {
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const SensorPath gap({{1.0, pose}, {1.1, pose}, {2.0, pose}, {2.1, pose}}, 0.02, 0.5);
  EXPECT_TRUE(gap.at(1.05).has_value());
  EXPECT_FALSE(gap.at(1.5).has_value());
  EXPECT_TRUE(gap.at(2.05).has_value());
  const SensorPath one({{1.0, pose}});
  EXPECT_TRUE(one.at(1.0).has_value());
  EXPECT_FALSE(one.at(1.001).has_value());
}

TEST(SensorPath, RefusesBadSamples) {
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d wrong = pose;
  wrong.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SensorPath({}), std::invalid_argument);
  EXPECT_THROW(SensorPath({{1.0, pose}, {1.0, pose}}), std::invalid_argument);
  EXPECT_THROW(SensorPath({{2.0, pose}, {1.0, pose}}), std::invalid_argument);
  EXPECT_THROW(SensorPath({{1.0, wrong}}), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
