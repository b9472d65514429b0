// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/image_pyramid.h"

#include "support/meshes.h"
#include "textured_scene.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

TEST(ImagePyramid, LevelZeroIsTheViewItself) {
  LabeledView view;
  view.view.camera = test::make_camera(40, 30, 50.0);
  view.gray = cv::Mat(30, 40, CV_8UC1, cv::Scalar(9));
  const LabeledView same = shrink_view(view, 0);
  EXPECT_EQ(same.gray.size(), view.gray.size());
  EXPECT_EQ(same.view.camera.fx, 50.0);
}

/// The camera and the image must keep together: a shrunken picture of a texture is the picture that
/// the shrunken camera would take.
TEST(ImagePyramid, ShrunkenCameraTakesTheShrunkenPicture) {
  const test::Texture texture(0.8, 3);
  const std::vector<View> poses =
      test::arc_of_views(test::make_camera(240, 180, 300.0), Eigen::Vector3d::Zero(), 3.0, 9.0, 2);
  const LabeledView fine = test::cast_view(poses[0], test::plane_surface(), texture);
  const LabeledView coarse = shrink_view(fine, 1);
  const LabeledView direct = test::cast_view(coarse.view, test::plane_surface(), texture);
  ASSERT_EQ(coarse.gray.size(), cv::Size(120, 90));
  EXPECT_LE(cv::norm(coarse.gray, direct.gray, cv::NORM_INF), 3.0);
}

TEST(ImagePyramid, LabelsAreDecidedByMajority) {
  cv::Mat labels(4, 6, CV_16UC1, cv::Scalar(5));
  labels.colRange(3, 6).setTo(cv::Scalar(7));
  labels.at<Label>(0, 0) = kUnlabelled;
  const cv::Mat small = shrink_labels(labels, cv::Size(3, 2));
  EXPECT_EQ(small.at<Label>(0, 0), 5);
  EXPECT_EQ(small.at<Label>(0, 1), 5);  // a tie goes to the lower id
  EXPECT_EQ(small.at<Label>(1, 2), 7);
}

TEST(ImagePyramid, OddSizesAreRounded) {
  LabeledView view;
  view.view.camera = test::make_camera(1241, 375, 700.0);
  view.gray = cv::Mat(375, 1241, CV_8UC1, cv::Scalar(9));
  view.labels = cv::Mat(375, 1241, CV_16UC1, cv::Scalar(3));
  const LabeledView small = shrink_view(view, 2);
  EXPECT_EQ(small.gray.size(), cv::Size(310, 94));
  EXPECT_EQ(small.labels.size(), small.gray.size());
  EXPECT_EQ(small.view.camera.width, 310);
  EXPECT_EQ(small.view.camera.height, 94);
  EXPECT_EQ(small.labels.at<Label>(93, 309), 3);
}

}  // namespace
}  // namespace facet_mapping
