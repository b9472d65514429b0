// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "ray_casting.h"
#include "support/meshes.h"
#include <gtest/gtest.h>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {
namespace {

FacetImage render(const TriangleMesh& mesh, const View& view) {
  return make_renderer()->render(mesh, view);
}

bool same(const FacetImage& a, const FacetImage& b) {
  return cv::norm(a.facets, b.facets, cv::NORM_INF) == 0.0 &&
         cv::norm(a.depth, b.depth, cv::NORM_INF) == 0.0;
}

/// True if a ray within a thousandth of a pixel around (x, y) sees `facet`.
bool seen_nearby(const TriangleMesh& mesh, const View& view, int x, int y, std::int32_t facet) {
  for (int k = 0; k < 16; ++k) {
    const double angle = 0.3927 * k;
    const Eigen::Vector2d offset(1e-3 * std::cos(angle), 1e-3 * std::sin(angle));
    if (test::cast_ray(mesh, view, Eigen::Vector2d(x, y) + offset).facet == facet) {
      return true;
    }
  }
  return false;
}

void expect_like_ray_casting(const TriangleMesh& mesh, const View& view) {
  const FacetImage image = render(mesh, view);
  int seen = 0;
  for (int y = 0; y < image.facets.rows; ++y) {
    for (int x = 0; x < image.facets.cols; ++x) {
      const test::RayHit hit = test::cast_ray(mesh, view, Eigen::Vector2d(x, y));
      const auto facet = image.facets.at<std::int32_t>(y, x);
      if (facet != hit.facet) {
        EXPECT_TRUE(seen_nearby(mesh, view, x, y, facet)) << "pixel " << x << " " << y;
      } else if (facet >= 0) {
        EXPECT_NEAR(image.depth.at<float>(y, x), hit.z, 1e-5 * hit.z);
        ++seen;
      } else {
        EXPECT_EQ(image.depth.at<float>(y, x), 0.0F);
      }
    }
  }
  EXPECT_GT(seen, image.facets.rows * image.facets.cols / 4);
}

TEST(SoftwareRenderer, AgreesWithRayCastingInsideARandomSoup) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const TriangleMesh mesh = test::make_soup(120, 3.0, 1.5, seed);
    expect_like_ray_casting(
        mesh, test::look_at(test::make_camera(61, 47, 35.0), {0.2, -0.1, 0.0}, {1.0, 0.4, 0.3}));
  }
}

TEST(SoftwareRenderer, AgreesWithRayCastingOnSmallFacetsFromOutside) {
  const TriangleMesh mesh = test::make_sphere(1.0, 3);
  expect_like_ray_casting(
      mesh, test::look_at(test::make_camera(60, 60, 70.0), {2.0, 1.1, 0.7}, {0, 0, 0}));
}

TEST(SoftwareRenderer, CutsTheRoadBelowTheCarExactly) {
  // Two facets of 400 m that run from far behind the camera to far ahead of it.
  const TriangleMesh road = test::make_grid_plane(1, 1, 400.0);
  const double height_m = 1.65;
  View view = test::look_at(test::make_camera(320, 160, 200.0), {0.3, -0.2, 0}, {1.3, -0.2, 0});
  view.world_from_cam.translation().z() = height_m;
  const FacetImage image = render(road, view);
  for (int y = 0; y < 160; ++y) {
    const double below_horizon = y - view.camera.cy;
    const double z = height_m * view.camera.fy / below_horizon;
    for (int x = 0; x < 320; ++x) {
      if (below_horizon > 2.0) {
        ASSERT_GE(image.facets.at<std::int32_t>(y, x), 0) << x << " " << y;
        ASSERT_NEAR(image.depth.at<float>(y, x), z, 1e-5 * z);
      } else if (below_horizon < 0.0) {
        ASSERT_EQ(image.facets.at<std::int32_t>(y, x), -1);
      }
    }
  }
}

TEST(SoftwareRenderer, ClosedMeshHasNoHoleFromInside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const TriangleMesh sphere = test::make_sphere(1.0, 5);
  const TriangleMesh box = test::make_box({0.8, 1.0, 1.2}, 4);
  for (int k = 0; k < 30; ++k) {
    const Eigen::Vector3d eye = 0.5 * Eigen::Vector3d(unit(random), unit(random), unit(random));
    const Eigen::Vector3d target = eye + Eigen::Vector3d(unit(random), unit(random), unit(random));
    const View view = test::look_at(test::make_camera(160, 120, 60.0 + k), eye, target);
    EXPECT_EQ(cv::countNonZero(render(sphere, view).facets < 0), 0);
    EXPECT_EQ(cv::countNonZero(render(box, view).facets < 0), 0);
  }
}

// Vertices and edges exactly on pixel centres: the case that fill rules are made for.
View view_with_vertices_on_pixel_centres() {
  View view = test::look_at(test::make_camera(65, 65, 64.0), {0, 0, 4.0}, {0, 0, 0});
  EXPECT_EQ(view.camera.cx, 32.0);
  return view;
}

TEST(SoftwareRenderer, SharedEdgesOnPixelCentresAreHitOnce) {
  const TriangleMesh plane = test::make_grid_plane(6, 6, 0.5);
  const View view = view_with_vertices_on_pixel_centres();
  cv::Mat hits(65, 65, CV_32SC1, cv::Scalar(0));
  for (const Triangle& triangle : plane.triangles) {
    TriangleMesh single;
    single.vertices = plane.vertices;
    single.triangles = {triangle};
    hits += (render(single, view).facets >= 0) / 255;
  }
  const FacetImage whole = render(plane, view);
  double most = 0.0;
  cv::minMaxLoc(hits, nullptr, &most);
  EXPECT_EQ(most, 1.0);
  EXPECT_EQ(cv::countNonZero(hits), cv::countNonZero(whole.facets >= 0));
  EXPECT_EQ(cv::countNonZero(hits), 48 * 48);  // 6 cells of 8 pixels: one border of two is owned
}

TEST(SoftwareRenderer, BothSidesAreDrawnAlike) {
  const TriangleMesh mesh = test::make_sphere(1.0, 2);
  const View view = test::look_at(test::make_camera(80, 60, 60.0), {2.0, 0.5, 0.4}, {0, 0, 0});
  EXPECT_TRUE(same(render(mesh, view), render(test::flipped(mesh), view)));
}

TEST(SoftwareRenderer, SmallerIndexIsSeenAtEqualDepth) {
  TriangleMesh mesh = test::make_grid_plane(2, 2, 1.0);
  const std::vector<Triangle> once = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.begin(), once.begin(), once.end());
  const FacetImage image = render(mesh, view_with_vertices_on_pixel_centres());
  double largest = 0.0;
  cv::minMaxLoc(image.facets, nullptr, &largest);
  EXPECT_EQ(largest, 7.0);
}

TEST(SoftwareRenderer, AnImageDoesNotDependOnWhatElseIsDrawnBeside) {
  const TriangleMesh mesh = test::make_soup(300, 3.0, 0.8, 11);
  View view = test::look_at(test::make_camera(128, 96, 80.0), {0, 0, 0}, {1.0, 0.2, 0.1});
  const FacetImage whole = render(mesh, view);
  view.camera.height = 37;
  const FacetImage top = render(mesh, view);
  const cv::Range rows(0, 37);
  EXPECT_TRUE(same(top, {whole.facets.rowRange(rows), whole.depth.rowRange(rows)}));
}

TEST(SoftwareRenderer, SeparateObjectsWorkInSeveralThreads) {
  const TriangleMesh mesh = test::make_soup(2000, 3.0, 0.4, 5);
  const View view = test::look_at(test::make_camera(200, 150, 120.0), {0, 0, 0}, {1.0, 0.2, 0.1});
  const FacetImage expected = render(mesh, view);
  std::vector<FacetImage> images(4);
  std::vector<std::thread> threads;
  threads.reserve(images.size());
  for (FacetImage& image : images) {
    threads.emplace_back([&] { image = render(mesh, view); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const FacetImage& image : images) {
    EXPECT_TRUE(same(image, expected));
  }
}

TEST(SoftwareRenderer, OneObjectServesMeshesAndImagesOfDifferentSize) {
  const auto renderer = make_renderer();
  const View large = test::look_at(test::make_camera(90, 70, 60.0), {2.0, 0.5, 0.4}, {0, 0, 0});
  const View small = test::look_at(test::make_camera(30, 20, 20.0), {2.0, 0.5, 0.4}, {0, 0, 0});
  renderer->render(test::make_sphere(1.0, 4), large);
  const TriangleMesh box = test::make_box({1.0, 0.5, 0.5}, 0);
  EXPECT_TRUE(same(renderer->render(box, small), render(box, small)));
}

TEST(SoftwareRenderer, EmptyMeshAndDegenerateFacetsShowNothing) {
  const View view = view_with_vertices_on_pixel_centres();
  EXPECT_EQ(cv::countNonZero(render(TriangleMesh(), view).facets != -1), 0);
  TriangleMesh line;
  line.vertices = {{-1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  line.triangles = {{0, 1, 2}, {0, 0, 1}, {2, 2, 2}};
  EXPECT_EQ(cv::countNonZero(render(line, view).facets != -1), 0);
}

TEST(SoftwareRenderer, FacetsInThePlaneOfTheCameraDoNoHarm) {
  TriangleMesh fin;  // seen exactly edge-on, reaching from behind the camera to ahead of it
  fin.vertices = {{0.0, 0.0, 9.0}, {0.0, 1.0, -3.0}, {0.0, -1.0, -3.0}};
  fin.triangles = {{0, 1, 2}};
  const FacetImage image = render(fin, view_with_vertices_on_pixel_centres());
  double least = 0.0;
  cv::minMaxLoc(image.depth, &least);
  EXPECT_GE(least, 0.0);
  EXPECT_TRUE(cv::checkRange(image.depth));
}

TEST(SoftwareRenderer, InvalidInputIsRefused) {
  const TriangleMesh mesh = test::make_sphere(1.0, 1);
  const View good = test::look_at(test::make_camera(20, 20, 20.0), {3, 0, 0}, {0, 0, 0});
  View view = good;
  view.camera.width = 0;
  EXPECT_THROW(render(mesh, view), std::invalid_argument);
  view = good;
  view.camera.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(render(mesh, view), std::invalid_argument);
  view = good;
  view.world_from_cam.linear() *= 2.0;
  EXPECT_THROW(render(mesh, view), std::invalid_argument);
  TriangleMesh broken = mesh;
  broken.triangles[3][1] = 1000;
  EXPECT_THROW(render(broken, good), std::invalid_argument);
  broken = mesh;
  broken.vertices[2].x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(render(broken, good), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
