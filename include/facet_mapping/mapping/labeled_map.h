// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The map that the mapper node owns: point frames in, labelled surface out.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "facet_mapping/carving/space_carver.h"
#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

/// What rays to points of `dynamic` classes do.
enum class DynamicPolicy {
  kDrop,  ///< nothing: the point is ignored
  kKeep,  ///< what everything else does (parked cars are part of the map)
};

struct MapConfig {
  CarvingConfig carving;
  DynamicPolicy dynamic = DynamicPolicy::kKeep;
  double min_range_m = 0.5;             ///< nearer points are dropped
  double max_range_m = 40.0;            ///< farther points are dropped
  double keyframe_translation_m = 0.5;  ///< a frame is a keyframe after this much motion ...
  double keyframe_rotation_deg = 10.0;  ///< ... or this much rotation, per sensor
};

/// What became of one frame, so that nothing is dropped silently.
struct FrameReport {
  bool keyframe = false;  ///< false: too near the last keyframe, nothing was added
  std::size_t used = 0;   ///< points that became rays
  std::size_t not_finite = 0;
  std::size_t out_of_range = 0;
  std::size_t unknown_label = 0;  ///< used as unlabelled
  std::size_t dynamic_dropped = 0;
};

class LabeledMap {
 public:
  LabeledMap(LabelSet labels, const MapConfig& config);

  /// Queues a frame for the next update(). `sensor` tells sources apart for the keyframe gate.
  /// Throws std::invalid_argument if the pose is not rigid.
  FrameReport add(const PointFrame& frame, const std::string& sensor = "");

  /// Integrates all queued frames and extracts the surface anew. False if nothing was queued.
  bool update();

  const TriangleMesh& mesh() const { return surface_.mesh; }
  const CarvedSurface& surface() const { return surface_; }
  CarvingStats stats() const { return carver_.stats(); }
  std::size_t keyframes() const { return keyframes_; }
  std::size_t pending() const { return pending_.size(); }
  double last_stamp() const { return last_stamp_; }
  const LabelSet& labels() const { return labels_; }

  void reset();

 private:
  bool is_keyframe(const PointFrame& frame, const std::string& sensor);
  bool admit(const LabeledPoint& point, FrameReport* report, CarvingFrame::Ray* ray) const;

  LabelSet labels_;
  MapConfig config_;
  SpaceCarver carver_;
  CarvedSurface surface_;
  std::vector<CarvingFrame> pending_;
  std::map<std::string, Eigen::Isometry3d> last_pose_;
  std::size_t keyframes_ = 0;
  double last_stamp_ = 0.0;
};

}  // namespace facet_mapping
