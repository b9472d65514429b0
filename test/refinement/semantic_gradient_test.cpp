// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <random>

#include "support/meshes.h"
#include "textured_scene.h"
#include <gtest/gtest.h>

#include "facet_mapping/refinement/semantic_energy.h"

namespace facet_mapping {
namespace {

constexpr double kMinCos = 0.1;
constexpr int kWindow = 9;

struct Problem {
  TriangleMesh mesh;
  std::vector<SemanticView> views;

  std::vector<View> poses() const {
    std::vector<View> result;
    for (const SemanticView& view : views) {
      result.push_back(view.view);
    }
    return result;
  }
};

/// The energy of an anti-aliased rendering: every pixel is cut into many, each of which pays its
/// share of what the pixel costs under the class that it shows.
double supersampled_energy(const Problem& problem,
                           const TriangleMesh& mesh,
                           const std::vector<SemanticGate>& gates) {
  constexpr int kFactor = 6;
  double sum = 0.0;
  for (std::size_t i = 0; i < problem.views.size(); ++i) {
    const cv::Mat& seen = problem.views[i].segmentation;
    View fine = problem.views[i].view;
    fine.camera = fine.camera.resized(fine.camera.width * kFactor, fine.camera.height * kFactor);
    const cv::Mat shown = label_image(make_renderer()->render(mesh, fine), mesh);
    for (int y = 0; y < shown.rows; ++y) {
      for (int x = 0; x < shown.cols; ++x) {
        const int row = y / kFactor;
        const int column = x / kFactor;
        sum += gates[i].cost(static_cast<std::uint32_t>(row * seen.cols + column),
                             shown.at<Label>(y, x),
                             seen.at<Label>(row, column));
      }
    }
  }
  return sum / (kFactor * kFactor);
}

std::vector<Eigen::Vector3d> random_direction(const TriangleMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    return Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  const Eigen::Vector3d shift = vector();
  const Eigen::Vector3d amplitude = vector();
  const Eigen::Vector3d frequency = 2.0 * vector();
  std::vector<Eigen::Vector3d> direction;
  for (const Eigen::Vector3d& x : mesh.vertices) {
    direction.emplace_back(shift + amplitude * std::sin(frequency.dot(x)));
  }
  return direction;
}

VertexField whole_gradient(const Problem& problem,
                           const std::vector<SurfaceView>& surfaces,
                           const std::vector<SemanticGate>& gates) {
  SemanticGradient parts = semantic_gradient(problem.mesh, problem.views, surfaces, gates);
  parts.contours.add(parts.seams);
  return parts.contours;
}

void expect_agreement(const Problem& problem, double tolerance) {
  const std::vector<SurfaceView> surfaces = render_surfaces(problem.mesh, problem.poses(), kMinCos);
  // The energy counts pixels beyond the end of an open mesh, whose motion the gradient leaves out.
  for (const SurfaceView& surface : surfaces) {
    ASSERT_EQ(cv::countNonZero(surface.image.facets < 0), 0);
  }
  const std::vector<SemanticGate> gates =
      semantic_gates(problem.mesh, problem.views, surfaces, kWindow);
  const VertexField field = whole_gradient(problem, surfaces, gates);
  constexpr double kStep = 4e-3;  // some tenths of a pixel
  double scale = 0.0;
  for (const Eigen::Vector3d& g : field.gradient) {
    scale += g.norm();
  }
  for (unsigned seed = 0; seed < 8; ++seed) {
    const std::vector<Eigen::Vector3d> direction = random_direction(problem.mesh, seed);
    TriangleMesh ahead = problem.mesh;
    TriangleMesh back = problem.mesh;
    double analytic = 0.0;
    for (std::size_t k = 0; k < direction.size(); ++k) {
      ahead.vertices[k] += kStep * direction[k];
      back.vertices[k] -= kStep * direction[k];
      analytic += field.gradient[k].dot(direction[k]);
    }
    const double expected =
        (supersampled_energy(problem, ahead, gates) - supersampled_energy(problem, back, gates)) /
        (2.0 * kStep);
    EXPECT_NEAR(analytic, expected, tolerance * std::max(std::abs(expected), 0.1 * scale));
  }
}

cv::Mat disc(const PinholeCamera& camera, double x, double y, double radius) {
  cv::Mat mask(camera.height, camera.width, CV_16UC1, cv::Scalar(0));
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.cols; ++column) {
      if (std::hypot(column - x, row - y) < radius) {
        mask.at<Label>(row, column) = 1;
      }
    }
  }
  return mask;
}

/// A ball (class 1) before a wall (class 0), whose masks are shifted and too large by some pixels.
Problem ball_before_wall(int subdivisions) {
  Problem problem;
  const TriangleMesh ball = test::make_sphere(0.6, subdivisions);
  TriangleMesh wall = test::make_grid_plane(12, 12, 0.9);
  for (Eigen::Vector3d& v : wall.vertices) {
    v.z() -= 1.5;
  }
  problem.mesh = test::joined(ball, wall);
  problem.mesh.labels.assign(problem.mesh.triangles.size(), 0);
  std::fill_n(problem.mesh.labels.begin(), ball.triangles.size(), Label{1});
  const PinholeCamera camera = test::make_camera(160, 120, 160.0);
  for (const double x : {-0.8, 0.7}) {
    const View view = test::look_at(camera, {x, 0.3, 3.0}, {0.0, 0.0, 0.0});
    const double radius = 160.0 * 0.6 / std::sqrt(view.center().squaredNorm() - 0.36);
    problem.views.push_back({view, disc(camera, 79.5 + 1.0, 59.5 - 0.8, radius + 3.0)});
  }
  return problem;
}

/// Two planes that meet in a ridge along y; the class changes at the ridge.
Problem roof() {
  Problem problem;
  problem.mesh =
      test::make_height_field(44, 44, 0.2, [](double x, double) { return -0.3 * std::abs(x); });
  for (const Triangle& t : problem.mesh.triangles) {
    const double x = problem.mesh.vertices[t[0]].x() + problem.mesh.vertices[t[1]].x() +
                     problem.mesh.vertices[t[2]].x();
    problem.mesh.labels.push_back(x < 0.0 ? 3 : 4);
  }
  const PinholeCamera camera = test::make_camera(160, 120, 160.0);
  for (const double x : {-0.9, 0.6}) {
    View view = test::view_with_y_up(camera, {x, 0.4, 2.5}, {0.05, 0.0, 0.0});
    // Rolled, so that the ridge lies at every position within the pixels.
    view.world_from_cam.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    cv::Mat mask(camera.height, camera.width, CV_16UC1, cv::Scalar(4));
    for (int row = 0; row < mask.rows; ++row) {
      for (int column = 0; column < mask.cols; ++column) {
        const Eigen::Vector3d ray =
            view.world_from_cam.linear() *
            camera.ray({static_cast<double>(column), static_cast<double>(row)});
        const Eigen::Vector3d hit = view.center() - view.center().z() / ray.z() * ray;
        // Nowhere within a step of the ridge, where the energy has a kink.
        if (hit.x() < 0.07 + 0.02 * std::sin(8.0 * hit.y())) {
          mask.at<Label>(row, column) = 3;
        }
      }
    }
    problem.views.push_back({view, mask});
  }
  return problem;
}

TEST(SemanticGradient, AgreesWithFiniteDifferencesAtAnOccludingContour) {
  expect_agreement(ball_before_wall(3), 0.05);
}

TEST(SemanticGradient, AgreesWithFiniteDifferencesForFacetsSmallerThanAPixel) {
  expect_agreement(ball_before_wall(6), 0.05);
}

TEST(SemanticGradient, AgreesWithFiniteDifferencesAtACrease) {
  expect_agreement(roof(), 0.03);
}

TEST(SemanticGradient, TheSurfaceBehindAContourGetsNoForce) {
  const Problem problem = ball_before_wall(4);
  const std::vector<SurfaceView> surfaces = render_surfaces(problem.mesh, problem.poses(), kMinCos);
  const std::vector<SemanticGate> gates =
      semantic_gates(problem.mesh, problem.views, surfaces, kWindow);
  const VertexField field = whole_gradient(problem, surfaces, gates);
  double on_ball = 0.0;
  for (std::size_t k = 0; k < field.gradient.size(); ++k) {
    if (problem.mesh.vertices[k].z() < -1.0) {
      EXPECT_EQ(field.gradient[k].norm(), 0.0);
      EXPECT_EQ(field.curvature[k], 0.0);
    } else {
      on_ball += field.gradient[k].norm();
    }
  }
  EXPECT_GT(on_ball, 10.0);
}

TEST(SemanticGradient, TheEndOfAnOpenMeshGetsNoForce) {
  Problem problem;
  problem.mesh = test::make_grid_plane(6, 6, 0.2);
  problem.mesh.labels.assign(problem.mesh.triangles.size(), 1);
  const PinholeCamera camera = test::make_camera(160, 120, 160.0);
  const cv::Mat everywhere(camera.height, camera.width, CV_16UC1, cv::Scalar(1));
  problem.views = {{test::look_at(camera, {0.2, 0.1, 3.0}, {0, 0, 0}), everywhere}};
  const std::vector<SurfaceView> surfaces = render_surfaces(problem.mesh, problem.poses(), kMinCos);
  const std::vector<SemanticGate> gates =
      semantic_gates(problem.mesh, problem.views, surfaces, kWindow);
  ASSERT_GT(semantic_energy(problem.mesh, problem.views, surfaces, gates).sum, 0.0);
  for (const Eigen::Vector3d& g : whole_gradient(problem, surfaces, gates).gradient) {
    EXPECT_EQ(g.norm(), 0.0);
  }
}

TEST(SemanticGradient, VanishesWhereMasksAgree) {
  Problem problem = roof();
  const std::vector<SurfaceView> surfaces = render_surfaces(problem.mesh, problem.poses(), kMinCos);
  for (std::size_t i = 0; i < problem.views.size(); ++i) {
    problem.views[i].segmentation = label_image(surfaces[i].image, problem.mesh);
  }
  const std::vector<SemanticGate> gates =
      semantic_gates(problem.mesh, problem.views, surfaces, kWindow);
  EXPECT_EQ(semantic_energy(problem.mesh, problem.views, surfaces, gates).sum, 0.0);
}

TEST(SemanticGradient, ViewsWithoutSegmentationSayNothing) {
  Problem problem = roof();
  for (SemanticView& view : problem.views) {
    view.segmentation.release();
  }
  const std::vector<SurfaceView> surfaces = render_surfaces(problem.mesh, problem.poses(), kMinCos);
  const std::vector<SemanticGate> gates =
      semantic_gates(problem.mesh, problem.views, surfaces, kWindow);
  EXPECT_EQ(semantic_energy(problem.mesh, problem.views, surfaces, gates).pixels, 0U);
  for (const Eigen::Vector3d& g : whole_gradient(problem, surfaces, gates).gradient) {
    EXPECT_EQ(g.norm(), 0.0);
  }
}

TEST(SemanticGradient, NormalPartIsParallelToTheNormals) {
  const Problem problem = roof();
  const std::vector<SurfaceView> surfaces = render_surfaces(problem.mesh, problem.poses(), kMinCos);
  const std::vector<SemanticGate> gates =
      semantic_gates(problem.mesh, problem.views, surfaces, kWindow);
  VertexField field = whole_gradient(problem, surfaces, gates);
  keep_normal_part(problem.mesh, &field);
  const std::vector<Eigen::Vector3d> normals = vertex_normals(problem.mesh);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    EXPECT_NEAR(field.gradient[k].cross(normals[k]).norm(), 0.0, 1e-9);
  }
  field = whole_gradient(problem, surfaces, gates);
  keep_tangential_part(problem.mesh, &field);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    EXPECT_NEAR(field.gradient[k].dot(normals[k]), 0.0, 1e-9);
  }
}

TEST(SemanticGradient, TellsContoursFromSeams) {
  for (const bool ball : {true, false}) {
    const Problem problem = ball ? ball_before_wall(4) : roof();
    const std::vector<SurfaceView> surfaces =
        render_surfaces(problem.mesh, problem.poses(), kMinCos);
    const std::vector<SemanticGate> gates =
        semantic_gates(problem.mesh, problem.views, surfaces, kWindow);
    const SemanticGradient parts = semantic_gradient(problem.mesh, problem.views, surfaces, gates);
    const VertexField& empty = ball ? parts.seams : parts.contours;
    for (const double h : empty.curvature) {
      EXPECT_EQ(h, 0.0);
    }
  }
}

}  // namespace
}  // namespace facet_mapping
