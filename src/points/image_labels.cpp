// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "excluded_labels.h"
#include "rules.h"
#include <opencv2/imgproc.hpp>

#include "facet_mapping/points/lidar_points.h"

namespace facet_mapping {
namespace {

/// Where the camera sees a point; depth 0 if it does not.
struct Projection {
  cv::Point pixel;
  float depth = 0.0F;  // metres
};

void check_input(const Eigen::Isometry3d& cam_from_sensor,
                 const PinholeCamera& camera,
                 const cv::Mat& labels,
                 const ImageLabelConfig& config,
                 const std::vector<Occluders>& occluders) {
  detail::Rules rules;
  rules.require(camera.is_valid(), "the camera has no valid intrinsics");
  rules.require(labels.type() == CV_16UC1, "the label image must hold 16-bit class ids");
  rules.require(labels.cols == camera.width && labels.rows == camera.height,
                "the label image must be of the camera's size; resize it without interpolation");
  rules.require(is_rigid(cam_from_sensor), "cam_from_sensor must be rigid and finite");
  rules.require(config.occluder_px >= 0 && config.occluder_px <= 100,
                "occluder_px must be from 0 to 100");
  rules.require(config.occlusion_margin >= 0.0, "occlusion_margin must not be negative");
  for (const Occluders& others : occluders) {
    rules.require(others.points != nullptr && is_rigid(others.cam_from_points),
                  "occluders must have points and a rigid transform");
  }
  rules.throw_if_broken("Points cannot be labelled from the image: ");
}

Projection project(const Eigen::Vector3d& point_in_cam, const PinholeCamera& camera) {
  if (!point_in_cam.allFinite() || point_in_cam.z() <= 0.0) {
    return {};
  }
  const Eigen::Vector2d pixel = camera.project(point_in_cam);
  if (!camera.contains(pixel, -0.5 + 1e-9)) {
    return {};
  }
  return {{static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))},
          static_cast<float>(point_in_cam.z())};
}

std::vector<Projection> project_all(const std::vector<LabeledPoint>& points,
                                    const Eigen::Isometry3d& cam_from_sensor,
                                    const PinholeCamera& camera) {
  std::vector<Projection> projections;
  projections.reserve(points.size());
  for (const LabeledPoint& point : points) {
    projections.push_back(project(cam_from_sensor * point.position.cast<double>(), camera));
  }
  return projections;
}

void draw_nearer(const std::vector<Projection>& projections, cv::Mat* depth) {
  for (const Projection& projection : projections) {
    if (projection.depth > 0.0F) {
      auto& nearest = depth->at<float>(projection.pixel);
      nearest = std::min(nearest, projection.depth);
    }
  }
}

/// Depth of the nearest point around each pixel (CV_32F, metres; infinity where there is none).
cv::Mat nearest_depth(const std::vector<Projection>& projections,
                      const std::vector<Occluders>& occluders,
                      const PinholeCamera& camera,
                      int radius_px) {
  cv::Mat depth(
      camera.height, camera.width, CV_32F, cv::Scalar(std::numeric_limits<float>::infinity()));
  draw_nearer(projections, &depth);
  for (const Occluders& others : occluders) {
    draw_nearer(project_all(*others.points, others.cam_from_points, camera), &depth);
  }
  if (radius_px > 0) {
    const int side = 2 * radius_px + 1;
    cv::erode(depth, depth, cv::Mat::ones(side, side, CV_8UC1));
  }
  return depth;
}

}  // namespace

std::size_t label_points_from_image(std::vector<LabeledPoint>& points,
                                    const Eigen::Isometry3d& cam_from_sensor,
                                    const PinholeCamera& camera,
                                    const cv::Mat& labels,
                                    const ImageLabelConfig& config,
                                    const std::vector<Occluders>& occluders) {
  check_input(cam_from_sensor, camera, labels, config, occluders);
  const std::vector<Projection> projections = project_all(points, cam_from_sensor, camera);
  const cv::Mat nearest = nearest_depth(projections, occluders, camera, config.occluder_px);
  const auto farthest = static_cast<float>(1.0 + config.occlusion_margin);
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Projection& seen = projections[i];
    if (seen.depth <= 0.0F || seen.depth > farthest * nearest.at<float>(seen.pixel)) {
      continue;
    }
    const Label label = labels.at<Label>(seen.pixel);
    if (label != kUnlabelled && !detail::is_excluded(label, config.excluded_labels)) {
      points[i].label = label;
      ++labelled;
    }
  }
  return labelled;
}

}  // namespace facet_mapping
