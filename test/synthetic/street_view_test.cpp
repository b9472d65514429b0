// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_view.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "synthetic/test_street.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/points/stereo_points.h"
#include "facet_mapping/synthetic/street_raycaster.h"

namespace facet_mapping {
namespace {

using testing::short_street;

template <typename T>
T median(std::vector<T> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// A stereo pair in the middle of the drive, without and with the camera's noise.
class StreetViewTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    rig_ = new StreetRig(kitti_rig(false));
    renderer_ = new StreetRenderer(short_street(), {});
    const Eigen::Isometry3d& pose = short_street().trajectory[7].map_from_left;
    left_view_ = new View(rig_->left_view(pose));
    right_view_ = new View(rig_->right_view(pose));
    left_ = new StreetImage(renderer_->render(*left_view_, {1.0, 1.5, 1}));
    right_ = new StreetImage(renderer_->render(*right_view_, {1.01, 1.5, 2}));
  }
  static void TearDownTestSuite() {
    delete right_;
    delete left_;
    delete right_view_;
    delete left_view_;
    delete renderer_;
    delete rig_;
  }

  static double disparity(float depth) { return rig_->camera.fx * rig_->baseline_m / depth; }

  static StreetRig* rig_;
  static StreetRenderer* renderer_;
  static View* left_view_;
  static View* right_view_;
  static StreetImage* left_;
  static StreetImage* right_;
};
StreetRig* StreetViewTest::rig_;
StreetRenderer* StreetViewTest::renderer_;
View* StreetViewTest::left_view_;
View* StreetViewTest::right_view_;
StreetImage* StreetViewTest::left_;
StreetImage* StreetViewTest::right_;

TEST_F(StreetViewTest, DepthAndLabelsEqualRayCasting) {
  const StreetRaycaster raycaster(short_street());
  std::mt19937 random(5);
  int differing = 0;
  constexpr int kPixels = 3000;
  for (int k = 0; k < kPixels; ++k) {
    const int x = static_cast<int>(random() % 621);
    const int y = static_cast<int>(random() % 188);
    const auto hit = raycaster.cast(
        left_view_->center(),
        left_view_->world_from_cam.linear() * rig_->camera.ray(Eigen::Vector2d(x, y)));
    const double depth = hit ? hit->distance : 0.0;  // the ray has z = 1
    const Label label = hit ? short_street().mesh.labels[hit->facet] : street_class::kSky;
    const bool same = std::abs(left_->depth.at<float>(y, x) - depth) < 1e-3 * (1.0 + depth) &&
                      left_->labels.at<std::uint8_t>(y, x) == label;
    differing += same ? 0 : 1;
  }
  EXPECT_LE(differing, kPixels / 500) << "only pixels on a silhouette may differ";
}

TEST_F(StreetViewTest, FacetsFaceTheCamera) {
  const FacetImage image = renderer_->render_facets(*left_view_);
  int behind = 0;
  int seen = 0;
  for (int y = 0; y < image.facets.rows; y += 3) {
    for (int x = 0; x < image.facets.cols; x += 3) {
      const auto facet = image.facets.at<std::int32_t>(y, x);
      if (facet >= 0) {
        const Eigen::Vector3d ray =
            left_view_->world_from_cam.linear() * rig_->camera.ray(Eigen::Vector2d(x, y));
        behind += facet_cross(short_street().mesh, facet).dot(ray) > 0.0 ? 1 : 0;
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 5000);
  EXPECT_LE(behind, seen / 500);
}

TEST_F(StreetViewTest, NothingShowsThroughTheGround) {
  View view = kitti_rig(true).left_view(Eigen::Isometry3d::Identity());
  for (const StreetPose& pose : short_street().trajectory) {
    view.world_from_cam = pose.map_from_left;
    const FacetImage image = renderer_->render_facets(view);
    int holes = 0;
    for (int y = 0; y < image.facets.rows; ++y) {
      for (int x = 0; x < image.facets.cols; ++x) {
        const Eigen::Vector3d ray =
            view.world_from_cam.linear() * view.camera.ray(Eigen::Vector2d(x, y));
        holes += image.facets.at<std::int32_t>(y, x) < 0 && ray.z() < 0.0 ? 1 : 0;
      }
    }
    EXPECT_EQ(holes, 0) << "at " << pose.stamp << " s";
  }
}

TEST_F(StreetViewTest, RightImageShowsTheLeftOneShiftedByTheDisparity) {
  std::vector<int> matched;
  std::vector<int> shifted;
  for (int y = 2; y < 186; y += 2) {
    for (int x = 60; x < 600; ++x) {
      const float depth = left_->depth.at<float>(y, x);
      const double right_x = x - (depth > 0.0F ? disparity(depth) : 1e9);
      const int nearest = static_cast<int>(std::lround(right_x));
      if (nearest < 6 || std::abs(right_x - nearest) > 0.1 ||
          std::abs(right_->depth.at<float>(y, nearest) - depth) > 0.01F * depth) {
        continue;  // outside, between pixels or hidden from the right camera
      }
      const int grey = left_->color.at<cv::Vec3b>(y, x)[1];
      matched.push_back(std::abs(grey - right_->color.at<cv::Vec3b>(y, nearest)[1]));
      shifted.push_back(std::abs(grey - right_->color.at<cv::Vec3b>(y, nearest - 4)[1]));
    }
  }
  ASSERT_GT(matched.size(), 3000U);
  EXPECT_LE(median(matched), 3);
  EXPECT_GT(median(shifted), 2 * median(matched));
}

TEST_F(StreetViewTest, SemiGlobalMatchingFindsTheExactDisparity) {
  cv::Mat left_gray;
  cv::Mat right_gray;
  cv::cvtColor(left_->color, left_gray, cv::COLOR_BGR2GRAY);
  cv::cvtColor(right_->color, right_gray, cv::COLOR_BGR2GRAY);
  StereoConfig config;
  config.num_disparities = 64;
  const cv::Mat found = stereo_disparity(left_gray, right_gray, config);
  std::vector<double> errors;
  std::vector<double> signed_errors;
  int surface = 0;
  for (int y = 0; y < found.rows; ++y) {
    for (int x = config.num_disparities; x < found.cols; ++x) {
      const float depth = left_->depth.at<float>(y, x);
      surface += depth > 0.0F ? 1 : 0;
      if (depth > 0.0F && std::isfinite(found.at<float>(y, x))) {
        signed_errors.push_back(found.at<float>(y, x) - disparity(depth));
        errors.push_back(std::abs(signed_errors.back()));
      }
    }
  }
  EXPECT_GT(errors.size(), 0.75 * surface) << "textures are too weak";
  EXPECT_LT(median(errors), 0.4);
  EXPECT_LT(std::abs(median(signed_errors)), 0.1) << "the cameras do not agree with the depth";
}

TEST_F(StreetViewTest, SameSeedSameBytes) {
  const StreetImage again = renderer_->render(*left_view_, {1.0, 1.5, 1});
  EXPECT_EQ(cv::norm(again.color, left_->color, cv::NORM_INF), 0.0);
  const StreetImage other = renderer_->render(*left_view_, {1.0, 1.5, 9});
  EXPECT_GT(cv::norm(other.color, left_->color, cv::NORM_L1), 0.0);
  EXPECT_EQ(cv::norm(other.depth, left_->depth, cv::NORM_INF), 0.0);
}

TEST_F(StreetViewTest, ExposureBrightens) {
  const StreetImage bright = renderer_->render(*left_view_, {1.3, 0.0, 1});
  EXPECT_GT(cv::mean(bright.color)[0], 1.05 * cv::mean(left_->color)[0]);
}

TEST_F(StreetViewTest, RefusesWhatItCannotRender) {
  StreetViewConfig config;
  config.supersampling = 2;
  EXPECT_THROW(StreetRenderer(short_street(), config), std::invalid_argument);
  config = {};
  config.haze_m = 0.0;
  EXPECT_THROW(StreetRenderer(short_street(), config), std::invalid_argument);
  View view = *left_view_;
  view.camera.fx = 0.0;
  EXPECT_THROW(renderer_->render(view, {}), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
