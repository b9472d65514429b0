// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/pictures.h"

#include <stdexcept>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/evaluation/legend.h"
#include "facet_mapping/evaluation/picture_views.h"

namespace facet_mapping {
namespace {

const cv::Vec3b kWhite(255, 255, 255);

LabelSet some_labels() {
  ClassInfo wall;
  wall.id = 2;
  wall.name = "wall";
  wall.color = {200, 10, 30};
  return LabelSet({wall});
}

// A wall at z = 2 whose left part (columns below 5) is class 2, the middle (5 to 9) unlabelled;
// columns from 10 on see nothing.
class PicturesTest : public ::testing::Test {
 protected:
  PicturesTest() {
    view_.camera = {15, 10, 10.0, 10.0, 7.0, 4.5};
    add_wall(-20.0, -0.5, 2);
    add_wall(-0.5, 0.5, kUnlabelled);
    image_ = make_renderer()->render(mesh_, view_);
  }

  void add_wall(double left, double right, Label label) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const double y : {-10.0, 10.0}) {
      mesh_.vertices.emplace_back(left, y, 2.0);
      mesh_.vertices.emplace_back(right, y, 2.0);
    }
    mesh_.triangles.push_back({first, first + 2, first + 1});
    mesh_.triangles.push_back({first + 1, first + 2, first + 3});
    mesh_.labels.insert(mesh_.labels.end(), 2, label);
  }

  TriangleMesh mesh_;
  View view_;
  FacetImage image_;
  LabelSet labels_ = some_labels();
};

TEST_F(PicturesTest, LabelsInClassColours) {
  const cv::Mat picture = label_picture(image_, mesh_, labels_);
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 0), cv::Vec3b(30, 10, 200));
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 7), cv::Vec3b(128, 128, 128));
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 14), kWhite);
}

TEST_F(PicturesTest, NormalsLookAtTheCamera) {
  const cv::Mat picture = normal_picture(image_, mesh_, view_);
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 0), cv::Vec3b(0, 128, 128));  // z = -1, x = y = 0
  for (Triangle& triangle : mesh_.triangles) {
    std::swap(triangle[0], triangle[1]);
  }
  EXPECT_EQ(normal_picture(image_, mesh_, view_).at<cv::Vec3b>(5, 0), cv::Vec3b(0, 128, 128));
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 14), kWhite);
}

TEST_F(PicturesTest, ShadedKeepsTheHue) {
  const cv::Vec3b pixel = shaded_picture(image_, mesh_, labels_, view_).at<cv::Vec3b>(5, 0);
  EXPECT_GT(pixel[2], pixel[0]);
  EXPECT_GT(pixel[0], pixel[1]);
  mesh_.labels.clear();
  const cv::Mat plain = shaded_picture(image_, mesh_, labels_, view_);
  EXPECT_EQ(plain.at<cv::Vec3b>(5, 14), kWhite);
  EXPECT_GT(plain.at<cv::Vec3b>(5, 0)[1], 100);
}

TEST_F(PicturesTest, DepthFromRedToBlue) {
  cv::Mat depth(1, 3, CV_32F);
  depth.at<float>(0, 0) = 1.0F;
  depth.at<float>(0, 1) = 10.0F;
  depth.at<float>(0, 2) = 0.0F;
  const DepthRange range = depth_range(depth);
  EXPECT_EQ(range.near_m, 1.0);
  const cv::Mat picture = depth_picture(depth, {1.0, 10.0});
  EXPECT_GT(picture.at<cv::Vec3b>(0, 0)[2], picture.at<cv::Vec3b>(0, 0)[0]);
  EXPECT_LT(picture.at<cv::Vec3b>(0, 1)[2], 60);
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 2), kWhite);
  EXPECT_EQ(depth_range(cv::Mat::zeros(2, 2, CV_32F)).far_m, 1.0);
  EXPECT_THROW(depth_picture(cv::Mat(1, 1, CV_8U), range), std::invalid_argument);
}

TEST_F(PicturesTest, ErrorsFromBlueToRedAndMagentaWhereTheMeshIsMissing) {
  const cv::Mat background = shaded_picture(image_, mesh_, labels_, view_);
  cv::Mat truth(image_.depth.size(), CV_32F, cv::Scalar(2.1F));
  truth.row(1).setTo(cv::Scalar(3.0F));
  truth.row(2).setTo(cv::Scalar(0.0F));
  const cv::Mat picture = error_picture(image_.depth, truth, 0.5, background);
  const cv::Vec3b good = picture.at<cv::Vec3b>(0, 0);
  const cv::Vec3b bad = picture.at<cv::Vec3b>(1, 0);
  EXPECT_GT(good[0], good[2]);
  EXPECT_GT(bad[2], bad[0] + bad[1]);
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 14), cv::Vec3b(255, 0, 255));
  const cv::Vec3b pale = picture.at<cv::Vec3b>(2, 0);
  EXPECT_EQ(pale[0], pale[2]);
  EXPECT_THROW(error_picture(image_.depth, truth, 0.0, background), std::invalid_argument);
  EXPECT_THROW(error_picture(image_.depth, cv::Mat(), 1.0, background), std::invalid_argument);
}

TEST_F(PicturesTest, SinglePixelsOfSparseTruthAreEnlarged) {
  const cv::Mat background(image_.depth.size(), CV_8UC3, cv::Scalar(255, 255, 255));
  cv::Mat truth = cv::Mat::zeros(image_.depth.size(), CV_32F);
  truth.at<float>(5, 2) = 2.1F;
  const cv::Mat picture = error_picture(image_.depth, truth, 0.5, background);
  EXPECT_EQ(picture.at<cv::Vec3b>(4, 3), picture.at<cv::Vec3b>(5, 2));
  EXPECT_NE(picture.at<cv::Vec3b>(5, 4), picture.at<cv::Vec3b>(5, 2));
}

TEST_F(PicturesTest, OverlayBlendsOnlyWhereThereIsAClass) {
  const cv::Mat photo(image_.depth.size(), CV_8UC3, cv::Scalar(100, 100, 100));
  const cv::Mat picture = overlay_picture(photo, image_, mesh_, labels_, 0.5);
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 0), cv::Vec3b(65, 55, 150));
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 7), cv::Vec3b(100, 100, 100));
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 14), cv::Vec3b(100, 100, 100));
  EXPECT_THROW(overlay_picture(cv::Mat(3, 3, CV_8UC3), image_, mesh_, labels_, 0.5),
               std::invalid_argument);
}

TEST_F(PicturesTest, LegendsStandBelowThePicture) {
  const cv::Mat picture(50, 300, CV_8UC3, cv::Scalar(1, 2, 3));
  cv::Mat classes(50, 300, CV_16U, cv::Scalar(kUnlabelled));
  EXPECT_EQ(with_class_legend(picture, classes, labels_).rows, 50);
  classes.at<Label>(3, 3) = 2;
  const cv::Mat with_legend = with_class_legend(picture, classes, labels_);
  EXPECT_GT(with_legend.rows, 60);
  EXPECT_EQ(with_legend.at<cv::Vec3b>(49, 299), cv::Vec3b(1, 2, 3));
  cv::Mat has_class_color;
  cv::inRange(with_legend, cv::Scalar(30, 10, 200), cv::Scalar(30, 10, 200), has_class_color);
  EXPECT_GT(cv::countNonZero(has_class_color), 100);
  EXPECT_GT(with_scale_legend(picture, "0", "1 m", false).rows, 60);
  EXPECT_GT(with_scale_legend(picture.colRange(0, 10), "far too long", "1 m", true).rows, 60);
}

TEST(PictureViews, TheTargetIsInTheMiddleAndUpIsUp) {
  const View view = look_at({0, 0, 5}, {10, 0, 0}, {0, 0, 1}, {641, 481}, 90.0);
  EXPECT_TRUE(is_rigid(view.world_from_cam));
  const Eigen::Vector3d target = view.cam_from_world() * Eigen::Vector3d(10, 0, 0);
  EXPECT_LT((view.camera.project(target) - Eigen::Vector2d(320, 240)).norm(), 1e-9);
  const Eigen::Vector3d above = view.cam_from_world() * Eigen::Vector3d(10, 0, 1);
  EXPECT_LT(view.camera.project(above).y(), 240.0);
  const Eigen::Vector3d left = view.cam_from_world() * Eigen::Vector3d(10, 1, 0);
  EXPECT_LT(view.camera.project(left).x(), 320.0);
  EXPECT_NEAR(view.camera.fx, 320.5, 1e-9);
}

TEST(PictureViews, ImpossibleViewsAreRefused) {
  const cv::Size size(64, 48);
  EXPECT_THROW(look_at({1, 2, 3}, {1, 2, 3}, {0, 0, 1}, size, 60), std::invalid_argument);
  EXPECT_THROW(look_at({1, 2, 3}, {1, 2, 0}, {0, 0, 1}, size, 60), std::invalid_argument);
  EXPECT_THROW(look_at({1, 2, 3}, {4, 2, 0}, {0, 0, 1}, {0, 48}, 60), std::invalid_argument);
  EXPECT_THROW(look_at({1, 2, 3}, {4, 2, 0}, {0, 0, 1}, size, 180), std::invalid_argument);
  EXPECT_THROW(bird_view(Dataset(), size, 60), std::invalid_argument);
}

TEST(PictureViews, ABirdSeesTheWholeTrajectory) {
  Dataset dataset;
  dataset.is_z_up = true;
  for (int k = 0; k < 40; ++k) {
    DatasetFrame frame;
    frame.view.world_from_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    frame.view.world_from_cam.translation() << k, 0, 0;
    dataset.frames.push_back(frame);
  }
  const View view = bird_view(dataset, {1280, 720}, 60);
  EXPECT_GT(view.center().z(), 5.0);
  EXPECT_LT(view.center().x(), 0.0);
  for (const DatasetFrame& frame : dataset.frames) {
    const Eigen::Vector3d seen = view.cam_from_world() * frame.view.center();
    EXPECT_GT(seen.z(), 0.0);
    EXPECT_TRUE(view.camera.contains(view.camera.project(seen)));
  }
}

}  // namespace
}  // namespace facet_mapping
