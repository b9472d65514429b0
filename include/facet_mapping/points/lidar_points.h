// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Labelled points from a LiDAR scan, the class taken from a camera's segmentation.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

struct CloudConfig {
  double min_range_m = 1.5;       ///< nearer points (the vehicle itself) are dropped
  double max_range_m = 80.0;      ///< farther points are dropped
  double outlier_radius_m = 0.5;  ///< points with too few others in this radius are dropped; 0: off
  int outlier_neighbors = 3;      ///< fewest other points in that radius
  double voxel_m = 0.2;           ///< at most one point per cube of this size; 0 keeps all
  double sigma_m = 0.03;          ///< standard deviation of the measured range, handed on
};

/// What became of a scan's points, so that nothing is dropped silently.
struct CloudReport {
  std::size_t not_finite = 0;
  std::size_t out_of_range = 0;
  std::size_t isolated = 0;
  std::size_t thinned = 0;
  std::size_t points = 0;  ///< kept
};

/// Thins a scan (sensor frame, metres) and drops the points that are isolated in it. What is kept
/// are measured points, in the order of the scan: of each cube the one nearest to its centre. All
/// labels are kUnlabelled. Throws std::invalid_argument on a config out of range.
std::vector<LabeledPoint> thin_cloud(const std::vector<Eigen::Vector3f>& scan,
                                     const CloudConfig& config,
                                     CloudReport* report = nullptr);

struct ImageLabelConfig {
  int occluder_px = 7;             ///< nearer points on two opposite sides, this near, hide a point
  int edge_px = 3;                 ///< so does one side, unless the point's surface goes on from it
  double occlusion_margin = 0.15;  ///< nearer: by more than this share of the depth
  std::vector<Label> excluded_labels;  ///< classes that no LiDAR return can be of (sky)
};

/// Points that may hide others, though they get no class themselves: the scan before it was
/// thinned, earlier scans. What moves since an earlier scan hides what is seen now at its old
/// place.
struct Occluders {
  const std::vector<LabeledPoint>* points = nullptr;
  Eigen::Isometry3d cam_from_points = Eigen::Isometry3d::Identity();
};

/// Gives each point that the camera sees the class of the nearest pixel of `labels` (CV_16UC1, size
/// of the camera, taken at the time of the scan). Points outside the image, hidden behind nearer
/// points (of theirs, or `occluders`), or on a pixel of an excluded class keep the label that they
/// have. `cam_from_sensor` goes to the camera's optical frame. Returns how many points took a
/// class. Throws std::invalid_argument on labels of another type or size, a camera without
/// intrinsics or a transform that is not rigid.
std::size_t label_points_from_image(std::vector<LabeledPoint>& points,
                                    const Eigen::Isometry3d& cam_from_sensor,
                                    const PinholeCamera& camera,
                                    const cv::Mat& labels,
                                    const ImageLabelConfig& config = {},
                                    const std::vector<Occluders>& occluders = {});

}  // namespace facet_mapping
