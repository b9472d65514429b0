// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameters of the nodes, and the tables that read, print and document them.
#pragma once

#include <string>
#include <vector>

#include "facet_mapping/mapping/labeled_map.h"
#include "facet_mapping/points/lidar_points.h"
#include "facet_mapping/points/sky_points.h"
#include "facet_mapping/points/stereo_points.h"
#include "facet_mapping/points/sweep_points.h"
#include "facet_mapping/points/track_points.h"
#include "facet_mapping/refinement/refiner.h"
#include "facet_mapping/ros/parameters.h"

namespace facet_mapping {

enum class ImageTransport { kRaw, kCompressed };

/// How a node gets the segmentation of its images.
struct SegmentationInput {
  std::string label_file = "cityscapes";  ///< path, or the name of a shipped list
  bool use_segmentation = true;           ///< false: geometry only
  ImageTransport transport = ImageTransport::kRaw;
  bool resize = true;           ///< accept label images of another size, if of the same shape
  double timeout_s = 2.0;       ///< how long an image waits for its segmentation, wall time
  double cache_s = 5.0;         ///< how long incomplete frames are kept, wall time
  double min_confidence = 0.0;  ///< less sure pixels are unlabelled; 0: no confidence images
};

/// What happens when stamps run backwards (a bag played in a loop).
enum class TimeJumpPolicy { kReset, kIgnore };

/// How a node finds the pose of its sensor.
struct PoseInput {
  std::string map_frame = "map";
  double tf_timeout_s = 5.0;  ///< how long a frame waits for its transform, wall time
  int tf_queue_size = 200;    ///< frames that may wait at once
  TimeJumpPolicy on_time_jump = TimeJumpPolicy::kReset;
};

/// How a node hands out its mesh.
struct MeshOutput {
  double chunk_size_m = 8.0;
  int marker_max_triangles = 300000;
};

struct StereoPointsNodeConfig {
  SegmentationInput segmentation;
  int queue_size = 200;  ///< pairs that may wait for the matcher
  StereoConfig stereo;
  SkyConfig sky;
};

/// What the sources of points from one moving camera have in common.
struct MovingCameraConfig {
  SegmentationInput segmentation;
  PoseInput pose;
  int queue_size = 10;         ///< images that may wait for the worker
  double flush_after_s = 2.0;  ///< without motion or images for so long, points wait no longer
  SkyConfig sky;
};

struct TrackPointsNodeConfig {
  MovingCameraConfig input;
  TrackConfig tracks;
};

struct SweepPointsNodeConfig {
  MovingCameraConfig input;
  SweepConfig sweep;
};

/// A map whose memory does not grow with the length of the drive.
inline MapConfig bounded_map() {
  MapConfig config;
  config.frozen_beyond_m = 70.0;
  return config;
}

struct MapperNodeConfig {
  std::string label_file = "cityscapes";
  std::vector<std::string> point_topics{"points"};
  PoseInput pose;
  MeshOutput output;
  int queue_size = 500;          ///< frames that may wait for the map
  double update_period_s = 0.5;  ///< least time between two updates, wall time
  std::string corrected_frame;   ///< whose poses come on keyframe_poses; "": the sensors' own
  std::string archive_folder;    ///< "": the system's temporary folder
  MapConfig map = bounded_map();
  CloudConfig cloud;  ///< cleaning of clouds without `label` (LiDAR); its range is that of the map
};

struct RefinerNodeConfig {
  SegmentationInput segmentation;
  PoseInput pose;
  MeshOutput output;
  double keyframe_translation_m = 0.5;
  double keyframe_rotation_deg = 10.0;
  int max_keyframes = 200;
  int max_keyframe_mib = 2048;
  RefinementConfig refinement;
};

/// The tables point into the struct, which must outlive them.
ParameterTable parameter_table(StereoPointsNodeConfig* config);
ParameterTable parameter_table(TrackPointsNodeConfig* config);
ParameterTable parameter_table(SweepPointsNodeConfig* config);
ParameterTable parameter_table(MapperNodeConfig* config);
ParameterTable parameter_table(RefinerNodeConfig* config);

}  // namespace facet_mapping
