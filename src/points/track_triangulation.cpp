// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "track_triangulation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace facet_mapping::detail {
namespace {

/// Along an edge a match is only as good as the epipolar line crosses the edge.
constexpr double kAlongEdge = 10.0;  // times the noise across it
constexpr int kIterations = 10;
/// Rays that span less than this have no point of meeting that arithmetic could find.
constexpr double kMinSpread = 1e-8;  // square of an angle in radians

Eigen::Vector3d world_ray(const Observation& observation) {
  const View& view = observation.from->view;
  return (view.world_from_cam.linear() * view.camera.ray(observation.pixel)).normalized();
}

/// The point nearest to all rays, relative to `origin`.
std::optional<Eigen::Vector3d> meet_rays(const std::vector<Observation>& observations,
                                         const Eigen::Vector3d& origin) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Observation& observation : observations) {
    const Eigen::Vector3d ray = world_ray(observation);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
    normal += across;
    right += across * (observation.from->view.center() - origin);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  if (!(solver.eigenvalues()(0) > kMinSpread)) {
    return std::nullopt;
  }
  return normal.ldlt().solve(right).eval();
}

/// Information of an observed pixel, in units of 1 / pixel_sigma^2.
Eigen::Matrix2d pixel_weight(const Observation& observation, bool is_first) {
  // The first pixel says which point of the edge is meant.
  if (is_first || observation.is_corner()) {
    return Eigen::Matrix2d::Identity();
  }
  const Eigen::Vector2d along(-observation.normal.y(), observation.normal.x());
  return observation.normal * observation.normal.transpose() +
         along * along.transpose() / (kAlongEdge * kAlongEdge);
}

struct NormalEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double cost = 0.0;
};

/// At a point given relative to `origin`; nothing if it is behind a camera.
std::optional<NormalEquations> linearize(const std::vector<Observation>& observations,
                                         const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& point) {
  NormalEquations sum;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const View& view = observations[k].from->view;
    const Eigen::Matrix3d cam_from_world = view.world_from_cam.linear().transpose();
    const Eigen::Vector3d in_cam = cam_from_world * (point - (view.center() - origin));
    if (!(in_cam.z() > 0.0)) {
      return std::nullopt;
    }
    const Eigen::Vector2d error = observations[k].pixel - view.camera.project(in_cam);
    const Eigen::Matrix<double, 2, 3> jacobian =
        view.camera.projection_jacobian(in_cam) * cam_from_world;
    const Eigen::Matrix2d weight = pixel_weight(observations[k], k == 0);
    sum.matrix += jacobian.transpose() * weight * jacobian;
    sum.right += jacobian.transpose() * weight * error;
    sum.cost += error.dot(weight * error);
  }
  return sum;
}

double largest_parallax(const std::vector<Observation>& observations) {
  const Eigen::Vector3d first = world_ray(observations.front());
  double largest = 0.0;
  for (const Observation& observation : observations) {
    const Eigen::Vector3d ray = world_ray(observation);
    largest = std::max(largest, std::atan2(first.cross(ray).norm(), first.dot(ray)));
  }
  return largest;
}

}  // namespace

double Triangulated::sigma_from(const Eigen::Vector3d& eye) const {
  const Eigen::Vector3d ray = (position - eye).normalized();
  return std::sqrt(std::max(0.0, ray.dot(covariance * ray)));
}

std::optional<Triangulated> triangulate_track(const std::vector<Observation>& observations,
                                              double pixel_sigma) {
  const Eigen::Vector3d origin = observations.front().from->view.center();
  const std::optional<Eigen::Vector3d> start = meet_rays(observations, origin);
  if (!start) {
    return std::nullopt;
  }
  Eigen::Vector3d point = *start;
  std::optional<NormalEquations> equations = linearize(observations, origin, point);
  for (int k = 0; k < kIterations && equations; ++k) {
    const Eigen::Vector3d step = equations->matrix.ldlt().solve(equations->right);
    const auto next = linearize(observations, origin, point + step);
    if (!next || !(next->cost <= equations->cost)) {
      break;
    }
    point += step;
    equations = next;
    if (step.squaredNorm() < 1e-12 * point.squaredNorm()) {
      break;
    }
  }
  if (!equations || !point.allFinite()) {
    return std::nullopt;
  }
  Triangulated result;
  result.position = origin + point;
  result.rms_px = std::sqrt(equations->cost / static_cast<double>(observations.size()));
  result.parallax_rad = largest_parallax(observations);
  const double noise = std::max(pixel_sigma, result.rms_px);
  // Each match starts from the one before, so that errors add up along a track: many observations
  // are worth no more than two free ones.
  const double shared = std::max(1.0, 0.5 * static_cast<double>(observations.size()));
  result.covariance = shared * noise * noise * equations->matrix.inverse();
  if (!result.covariance.allFinite()) {
    return std::nullopt;
  }
  return result;
}

}  // namespace facet_mapping::detail
