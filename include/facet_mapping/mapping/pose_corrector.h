// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Corrected poses (of a loop closure, say) and the keyframes that they belong to.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "facet_mapping/mapping/labeled_map.h"

namespace facet_mapping {

/// The new pose of a frame of the vehicle at one instant.
struct PoseCorrection {
  std::optional<KeyframeId> id;  ///< without it the stamp names the keyframes
  double stamp = 0.0;            ///< seconds
  Eigen::Isometry3d world_from_frame = Eigen::Isometry3d::Identity();
};

struct PoseCorrections {
  std::vector<PoseCorrection> poses;
  /// True: each pose is that of its keyframe's own sensor.
  bool of_sensor = true;
  /// Else: where each sensor is in the frame whose poses these are.
  std::map<std::string, Eigen::Isometry3d> frame_from_sensor;
};

/// What became of corrected poses; every pose counts once, but one whose stamp several sensors'
/// keyframes share counts for each.
struct CorrectionReport {
  std::size_t moved = 0;
  std::size_t unchanged = 0;     ///< less than 1 mm and 0.01 degrees from the present pose
  std::size_t frozen = 0;        ///< the keyframe cannot move any more
  std::size_t unknown = 0;       ///< no keyframe has this id, or a stamp within 1 ms
  std::size_t ambiguous = 0;     ///< several sensors have a keyframe of this stamp
  std::size_t not_rigid = 0;     ///< not finite, not rigid, or farther than 1e7 m away
  std::size_t not_attached = 0;  ///< nobody said where the sensor is in the corrected frame
  double unknown_stamp = 0.0;    ///< of the last unknown one, seconds
};

/// Knows all keyframes of a map since its start, the frozen ones, too.
class PoseCorrector {
 public:
  /// Takes note of new keyframes; call after LabeledMap::add and before update().
  void note(const LabeledMap& map);
  /// Queues in the map what the poses change.
  CorrectionReport apply(const PoseCorrections& corrections, LabeledMap* map);
  std::size_t bytes() const;  ///< of memory held
  void clear();

 private:
  struct Known {
    std::string sensor;
    Eigen::Isometry3d world_from_sensor = Eigen::Isometry3d::Identity();
  };

  std::vector<KeyframeId> named_by(const PoseCorrection& pose) const;
  void move(KeyframeId id,
            const Eigen::Isometry3d& world_from_sensor,
            LabeledMap* map,
            CorrectionReport* report);

  std::map<KeyframeId, Known> known_;
  std::multimap<double, KeyframeId> by_stamp_;
  KeyframeId next_ = 0;
};

}  // namespace facet_mapping
