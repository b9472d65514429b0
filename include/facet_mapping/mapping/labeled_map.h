// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The map that the mapper node owns: point frames in, labelled surface out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "facet_mapping/carving/space_carver.h"
#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/mapping/freeze_line.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

/// What rays to points of `dynamic` classes do.
enum class DynamicPolicy {
  kDrop,   ///< nothing: the point is ignored
  kCarve,  ///< they carve, but there is no surface at their end
  kKeep,   ///< what everything else does (parked cars are part of the map)
};

struct MapConfig {
  CarvingConfig carving;
  DynamicPolicy dynamic = DynamicPolicy::kKeep;
  double min_range_m = 0.5;             ///< nearer points are dropped
  double max_range_m = 40.0;            ///< farther points are dropped
  double keyframe_translation_m = 0.5;  ///< a frame is a keyframe after this much motion ...
  double keyframe_rotation_deg = 10.0;  ///< ... or this much rotation, per sensor
  double frozen_beyond_m = 0.0;   ///< the surface farther from the newest keyframe is final and
                                  ///< its rays are forgotten; 0 = never
  double memory_budget_mb = 0.0;  ///< MiB; above it the ranges shrink; 0 = no limit
};

/// Of one frame in the map: its place in the order of arrival, never used twice until reset().
using KeyframeId = std::uint32_t;

struct Keyframe {
  double stamp = 0.0;  ///< seconds
  std::string sensor;
  Eigen::Isometry3d world_from_sensor = Eigen::Isometry3d::Identity();
};

/// What became of one frame, so that nothing is dropped silently.
struct FrameReport {
  bool keyframe = false;  ///< false: too near the last keyframe, nothing was added
  std::size_t used = 0;   ///< points that became rays
  std::size_t not_finite = 0;
  std::size_t out_of_range = 0;
  std::size_t unknown_label = 0;  ///< used as unlabelled
  std::size_t dynamic_dropped = 0;
  std::size_t dynamic_carving = 0;  ///< used, without a surface at their end
};

class LabeledMap {
 public:
  LabeledMap(LabelSet labels, const MapConfig& config);

  /// Queues a frame for the next update(). `sensor` tells sources apart for the keyframe gate.
  /// Throws std::invalid_argument if the pose is not rigid.
  FrameReport add(const PointFrame& frame, const std::string& sensor = "");

  /// Queues a new pose for a keyframe (after a loop closure, say): at the next update() its points
  /// and rays move with it, and the map is what it would be had the pose been this from the start
  /// (the keyframe counts as the newest). False if the keyframe is frozen or unknown.
  /// Throws std::invalid_argument if the pose is not rigid.
  bool move(KeyframeId id, const Eigen::Isometry3d& world_from_sensor);

  /// Integrates all that is queued and brings the surface up to date. False if nothing was queued.
  bool update();

  const TriangleMesh& mesh() const { return surface_.mesh; }
  const CarvedSurface& surface() const { return surface_; }
  CarvingStats stats() const { return carver_.stats(); }
  /// Frames integrated since the start, frozen ones too.
  std::size_t keyframes() const { return keyframe_count_; }
  /// The keyframes that can still move, with their present poses.
  std::map<KeyframeId, Keyframe> movable_keyframes() const;
  std::size_t pending() const { return pending_.size() + moves_.size(); }
  /// What the last update() froze. Take over the chunks outside before the next update().
  const FreezeLine& freeze_line() const { return freeze_line_; }
  /// 1, or less while the memory budget makes the ranges shrink.
  double range_scale() const { return range_scale_; }
  /// Bytes of memory held, allocator overhead included.
  std::size_t bytes() const;
  double last_stamp() const { return last_stamp_; }
  const LabelSet& labels() const { return labels_; }

  void reset();

 private:
  /// A frame that is in the map or about to be.
  struct Held {
    PointFrame frame;
    std::string sensor;
    FrameId carving_id = 0;  ///< once it is in the map
  };

  bool is_keyframe(const PointFrame& frame, const std::string& sensor);
  bool admit(const LabeledPoint& point, FrameReport* report, CarvingFrame::Ray* ray) const;
  double reach() const { return range_scale_ * config_.max_range_m; }
  CarvingFrame carving_frame(const PointFrame& frame, FrameReport* report) const;
  void integrate();
  void forget();
  void freeze();
  void obey_budget();

  LabelSet labels_;
  MapConfig config_;
  SpaceCarver carver_;
  CarvedSurface surface_;
  std::map<KeyframeId, Held> held_;
  std::vector<std::pair<KeyframeId, CarvingFrame>> pending_;
  std::map<KeyframeId, Eigen::Isometry3d> moves_;
  std::map<std::string, Eigen::Isometry3d> last_pose_;
  FreezeLine freeze_line_;
  std::size_t vertices_left_ = 0;  // by the last forget()
  Eigen::Vector3d newest_position_ = Eigen::Vector3d::Zero();
  double range_scale_ = 1.0;
  std::size_t keyframe_count_ = 0;
  double last_stamp_ = 0.0;
};

}  // namespace facet_mapping
