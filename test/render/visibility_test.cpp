// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/render/visibility.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "support/meshes.h"
#include <gtest/gtest.h>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {
namespace {

constexpr double kTolerance = 0.02;

class Visibility : public ::testing::Test {
 protected:
  Visibility()
      : mesh_(test::make_sphere(1.0, 5)),
        view_(test::look_at(test::make_camera(200, 160, 200.0), {3.0, 0, 0}, {0, 0, 0})),
        image_(make_renderer()->render(mesh_, view_)) {}

  bool sees(const Eigen::Vector3d& point) const {
    return visible_in(view_, image_.depth, point, kTolerance);
  }

  TriangleMesh mesh_;
  View view_;
  FacetImage image_;
};

TEST_F(Visibility, NearSideIsSeenFarSideIsHidden) {
  int seen = 0;
  for (const Eigen::Vector3d& vertex : mesh_.vertices) {
    const double facing = vertex.dot(view_.center() - vertex);
    if (facing > 0.8) {  // flatter facets slope more than the tolerance within a pixel
      EXPECT_TRUE(sees(vertex));
      ++seen;
    } else if (facing < -0.3) {
      EXPECT_FALSE(sees(vertex));
    }
  }
  EXPECT_GT(seen, 150);
}

TEST_F(Visibility, ToleranceIsRelativeAndTwoSided) {
  EXPECT_TRUE(sees({1.0, 0, 0}));  // depth 2
  EXPECT_TRUE(sees({0.97, 0, 0}));
  EXPECT_TRUE(sees({1.03, 0, 0}));
  EXPECT_FALSE(sees({0.95, 0, 0}));
  EXPECT_FALSE(sees({1.05, 0, 0}));
}

TEST_F(Visibility, NothingOutsideTheImageBehindOrAgainstTheVoid) {
  EXPECT_FALSE(sees({5.0, 0, 0}));
  EXPECT_FALSE(sees({3.0, 0, 0}));
  EXPECT_FALSE(sees({1.0, 4.0, 0}));
  EXPECT_FALSE(sees({1.0, 0.7, 0.7}));  // beside the silhouette
  EXPECT_FALSE(sees(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())));
}

TEST_F(Visibility, GivesTheNearestPixel) {
  const VisibilityTest test(view_, image_.depth, kTolerance);
  const auto pixel = test.pixel({1.0, 0, 0});  // projects to (99.5, 79.5)
  ASSERT_TRUE(pixel.has_value());
  EXPECT_LE(std::abs(pixel->x - 99.5), 0.5);
  EXPECT_LE(std::abs(pixel->y - 79.5), 0.5);
}

TEST_F(Visibility, ImageOfOtherSizeIsRefused) {
  EXPECT_THROW(VisibilityTest(view_, cv::Mat(3, 3, CV_32FC1), kTolerance), std::invalid_argument);
  EXPECT_THROW(VisibilityTest(view_, image_.facets, kTolerance), std::invalid_argument);
  EXPECT_THROW(VisibilityTest(view_, image_.depth, -1.0), std::invalid_argument);
}

TEST_F(Visibility, LabelImageShowsFacetLabels) {
  EXPECT_EQ(cv::countNonZero(label_image(image_, mesh_) != kUnlabelled), 0);
  for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
    mesh_.labels.push_back(static_cast<Label>(f % 7));
  }
  const cv::Mat labels = label_image(image_, mesh_);
  ASSERT_EQ(labels.type(), CV_16UC1);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int facet = image_.facets.at<int>(y, x);
      EXPECT_EQ(labels.at<Label>(y, x), facet < 0 ? kUnlabelled : facet % 7);
    }
  }
  EXPECT_THROW(label_image(image_, test::make_sphere(1.0, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
