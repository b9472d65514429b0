// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The two backends against each other; skipped with the reason where OSMesa cannot start.
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "ray_casting.h"
#include "support/meshes.h"
#include <gtest/gtest.h>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {
namespace {

// OSMesa snaps positions to 1/256 pixel, so facets may differ along edges; depth is single
// precision there.
constexpr double kLargestShareOfOtherFacets = 0.005;
constexpr double kDepthTolerance = 1e-4;

class OsmesaRenderer : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      osmesa_ = make_renderer(RenderBackend::kOsmesa);
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  void expect_like_software(const TriangleMesh& mesh, const View& view) {
    const FacetImage reference = osmesa_->render(mesh, view);
    const FacetImage image = make_renderer()->render(mesh, view);
    const cv::Mat differs = image.facets != reference.facets;
    EXPECT_LE(cv::countNonZero(differs), kLargestShareOfOtherFacets * differs.total());
    EXPECT_GT(cv::countNonZero(image.facets >= 0), 0.2 * differs.total());
    for (int y = 0; y < differs.rows; ++y) {
      for (int x = 0; x < differs.cols; ++x) {
        if (differs.at<std::uint8_t>(y, x) == 0) {
          const double depth = image.depth.at<float>(y, x);
          ASSERT_NEAR(reference.depth.at<float>(y, x), depth, kDepthTolerance * depth)
              << "pixel " << x << " " << y;
        }
      }
    }
  }

  std::unique_ptr<FacetRenderer> osmesa_;
};

TEST_F(OsmesaRenderer, AgreesOnASphere) {
  const View view = test::look_at(test::make_camera(320, 240, 300.0), {2.0, 1.0, 0.7}, {0, 0, 0});
  expect_like_software(test::make_sphere(1.0, 5), view);
}

TEST_F(OsmesaRenderer, AgreesInsideASoupThatIsClipped) {
  const View view = test::look_at(test::make_camera(320, 240, 160.0), {0, 0, 0}, {1.0, 0.3, 0.1});
  expect_like_software(test::make_soup(400, 3.0, 1.0, 21), view);
}

TEST_F(OsmesaRenderer, AgreesOnARoadWithAnOffCentreCamera) {
  View view = test::look_at(test::make_camera(300, 101, 180.0), {0.1, 0.2, 1.65}, {9, 1, 1.2});
  view.camera.fy = 175.0;
  view.camera.cx += 17.3;
  view.camera.cy -= 8.9;
  expect_like_software(test::make_grid_plane(40, 40, 2.5), view);
}

TEST_F(OsmesaRenderer, ImagesOfDifferentSizeFollowEachOther) {
  const TriangleMesh mesh = test::make_sphere(1.0, 4);
  for (const int width : {64, 200, 64, 33}) {
    expect_like_software(
        mesh, test::look_at(test::make_camera(width, 50, 60.0), {2.0, 0.3, 0.1}, {0, 0, 0}));
  }
}

TEST_F(OsmesaRenderer, SmallerIndexIsSeenAtEqualDepth) {
  TriangleMesh mesh = test::make_sphere(1.0, 2);
  const auto once = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  const View view = test::look_at(test::make_camera(80, 60, 60.0), {2.0, 1.0, 0.7}, {0, 0, 0});
  double largest = 0.0;
  cv::minMaxLoc(osmesa_->render(mesh, view).facets, nullptr, &largest);
  EXPECT_LT(largest, once.size());
}

TEST_F(OsmesaRenderer, WorksFromSeveralThreads) {
  const View view = test::look_at(test::make_camera(80, 60, 60.0), {2.0, 1.0, 0.7}, {0, 0, 0});
  const TriangleMesh mesh = test::make_sphere(1.0, 4);
  const FacetImage expected = osmesa_->render(mesh, view);
  FacetImage images[2];
  std::thread first([&] { images[0] = make_renderer(RenderBackend::kOsmesa)->render(mesh, view); });
  std::thread second([&] { images[1] = osmesa_->render(mesh, view); });
  first.join();
  second.join();
  for (const FacetImage& image : images) {
    EXPECT_EQ(cv::norm(image.facets, expected.facets, cv::NORM_INF), 0.0);
    EXPECT_EQ(cv::norm(image.depth, expected.depth, cv::NORM_INF), 0.0);
  }
}

TEST_F(OsmesaRenderer, EmptyMeshShowsNothingAndInvalidCameraIsRefused) {
  View view = test::look_at(test::make_camera(40, 30, 30.0), {3, 0, 0}, {0, 0, 0});
  EXPECT_EQ(cv::countNonZero(osmesa_->render(TriangleMesh(), view).facets != -1), 0);
  view.camera.height = -3;
  EXPECT_THROW(osmesa_->render(TriangleMesh(), view), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
