// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/sky_points.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

constexpr Label kSky = 10;

PinholeCamera small_camera() {
  PinholeCamera camera;
  camera.width = 64;
  camera.height = 48;
  camera.fx = camera.fy = 50.0;
  camera.cx = 31.5;
  camera.cy = 23.5;
  return camera;
}

TEST(SkyPoints, OneRayPerSquareThatIsSkyAllOver) {
  cv::Mat labels(48, 64, CV_16UC1, cv::Scalar(2));
  labels(cv::Rect(0, 0, 64, 32)).setTo(kSky);
  labels.at<Label>(5, 20) = 2;  // spoils the square at x = 16
  const PinholeCamera camera = small_camera();
  const auto points = sky_points(labels, camera, {kSky}, {16, 30.0});
  ASSERT_EQ(points.size(), 7U);
  for (const LabeledPoint& point : points) {
    EXPECT_EQ(point.label, kSky);
    EXPECT_NEAR(point.position.norm(), 30.0F, 1e-4F);
    const Eigen::Vector2d pixel = camera.project(point.position.cast<double>());
    EXPECT_LT(pixel.y(), 32.0);
    EXPECT_FALSE(pixel.y() < 16.0 && pixel.x() > 16.0 && pixel.x() < 32.0);
  }
}

TEST(SkyPoints, NoLabelsOrNoSkyNoPoints) {
  const cv::Mat labels(48, 64, CV_16UC1, cv::Scalar(kSky));
  EXPECT_TRUE(sky_points(cv::Mat(), small_camera(), {kSky}, {}).empty());
  EXPECT_TRUE(sky_points(labels, small_camera(), {}, {}).empty());
  EXPECT_TRUE(sky_points(labels, small_camera(), {kSky}, {0, 30.0}).empty());
}

TEST(SkyPoints, RefusesWhatDoesNotFit) {
  const cv::Mat labels(48, 60, CV_16UC1, cv::Scalar(kSky));
  EXPECT_THROW(sky_points(labels, small_camera(), {kSky}, {}), std::invalid_argument);
  const cv::Mat bytes(48, 64, CV_8UC1, cv::Scalar(kSky));
  EXPECT_THROW(sky_points(bytes, small_camera(), {kSky}, {}), std::invalid_argument);
  const cv::Mat good(48, 64, CV_16UC1, cv::Scalar(kSky));
  EXPECT_THROW(sky_points(good, small_camera(), {kSky}, {-1, 30.0}), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
