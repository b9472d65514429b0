// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "excluded_labels.h"
#include "rules.h"

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
  rules.require(config.edge_px >= 0 && config.edge_px <= 100, "edge_px must be from 0 to 100");
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

/// Depth of the nearest point on each pixel (CV_32F, metres; infinity where there is none).
cv::Mat nearest_depth(const std::vector<Projection>& projections,
                      const std::vector<Occluders>& occluders,
                      const PinholeCamera& camera) {
  cv::Mat depth(
      camera.height, camera.width, CV_32F, cv::Scalar(std::numeric_limits<float>::infinity()));
  draw_nearer(projections, &depth);
  for (const Occluders& others : occluders) {
    draw_nearer(project_all(*others.points, others.cam_from_points, camera), &depth);
  }
  return depth;
}

/// Nearest and farthest depth in a rectangle; infinity and 0 if nothing is there.
struct DepthRange {
  float nearest = std::numeric_limits<float>::infinity();
  float farthest = 0.0F;
};

DepthRange range_in(const cv::Mat& depth, const cv::Rect& rectangle) {
  const cv::Rect part = rectangle & cv::Rect(0, 0, depth.cols, depth.rows);
  DepthRange range;
  for (int y = part.y; y < part.y + part.height; ++y) {
    const auto* row = depth.ptr<float>(y);
    for (int x = part.x; x < part.x + part.width; ++x) {
      if (std::isfinite(row[x])) {
        range.nearest = std::min(range.nearest, row[x]);
        range.farthest = std::max(range.farthest, row[x]);
      }
    }
  }
  return range;
}

constexpr int kAside = 1;  // pixels to either side of a line through the point
constexpr int kWidth = 2 * kAside + 1;

/// The two sides of a pixel along a row or a column.
std::array<DepthRange, 2> sides_of(const cv::Mat& depth, const cv::Point& p, int reach, bool row) {
  if (row) {
    return {range_in(depth, {p.x - reach, p.y - kAside, reach, kWidth}),
            range_in(depth, {p.x + 1, p.y - kAside, reach, kWidth})};
  }
  return {range_in(depth, {p.x - kAside, p.y - reach, kWidth, reach}),
          range_in(depth, {p.x - kAside, p.y + 1, kWidth, reach})};
}

/// True if the surface goes on to the other side as it comes from the near one, as a road does:
/// along a plane the inverse of the depth is linear in the image.
bool goes_on(float depth, const DepthRange& near_side, const DepthRange& other_side) {
  const float step = 1.0F / near_side.nearest - 1.0F / depth;
  return other_side.farthest > 0.0F && 1.0F / depth - 1.0F / other_side.farthest > 0.5F * step;
}

bool is_hidden_along(const Projection& seen,
                     const cv::Mat& depth,
                     const ImageLabelConfig& config,
                     float limit,
                     bool row) {
  const auto far_sides = sides_of(depth, seen.pixel, config.occluder_px, row);
  if (far_sides[0].nearest < limit && far_sides[1].nearest < limit) {
    return true;
  }
  const auto [a, b] = sides_of(depth, seen.pixel, config.edge_px, row);
  return (a.nearest < limit && !goes_on(seen.depth, a, b)) ||
         (b.nearest < limit && !goes_on(seen.depth, b, a));
}

/// Hidden: something is clearly nearer on the same pixel, within occluder_px on two opposite sides,
/// or within edge_px on one, unless there it is a part of the point's own surface.
bool is_hidden(const Projection& seen, const cv::Mat& depth, const ImageLabelConfig& config) {
  const float limit = seen.depth / static_cast<float>(1.0 + config.occlusion_margin);
  return depth.at<float>(seen.pixel) < limit || is_hidden_along(seen, depth, config, limit, true) ||
         is_hidden_along(seen, depth, config, limit, false);
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
  const cv::Mat nearest = nearest_depth(projections, occluders, camera);
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Projection& seen = projections[i];
    if (seen.depth <= 0.0F || is_hidden(seen, nearest, config)) {
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
