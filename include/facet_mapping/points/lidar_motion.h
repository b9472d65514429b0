// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Motion compensation: the points of a scan as if all had been measured at one instant.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "facet_mapping/points/lidar_scan.h"

namespace facet_mapping {

struct StampedPose {
  double stamp = 0.0;  ///< seconds
  Eigen::Isometry3d world_from_sensor = Eigen::Isometry3d::Identity();
};

/// Poses of a sensor between samples: positions linear, rotations by slerp.
class SensorPath {
 public:
  /// `poses` with increasing stamps. Beyond the ends the motion goes on for at most
  /// `max_extrapolation_s`; samples farther apart than `max_gap_s` are not bridged. Throws
  /// std::invalid_argument on no pose, stamps that do not increase, poses that are not rigid.
  explicit SensorPath(std::vector<StampedPose> poses,
                      double max_extrapolation_s = 0.02,
                      double max_gap_s = 0.5);

  /// world_from_sensor; nothing where the samples do not say it.
  std::optional<Eigen::Isometry3d> at(double stamp) const;
  /// Length of the sensor's way from the first sample to `stamp`, metres (0 before the first).
  double way_m(double stamp) const;
  /// The inverse of way_m; the last sample's stamp if the way is shorter.
  double stamp_at(double way_m) const;

  double first() const { return poses_.front().stamp; }
  double last() const { return poses_.back().stamp; }

 private:
  std::optional<Eigen::Isometry3d> before_first(double stamp) const;
  std::optional<Eigen::Isometry3d> after_last(double stamp) const;

  std::vector<StampedPose> poses_;
  std::vector<double> ways_m_;  // of each pose
  double max_extrapolation_s_;
  double max_gap_s_;
};

/// Points of a scan, all in the sensor's frame at `stamp`.
struct CompensatedScan {
  double stamp = 0.0;  ///< seconds
  Eigen::Isometry3d world_from_sensor = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector3f> points;  ///< metres
};

struct MotionReport {
  std::size_t without_time = 0;  ///< dropped: their offset is not finite
  double seconds = 0.0;          ///< between the first and the last point
  double moved_m = 0.0;          ///< the sensor's way meanwhile
};

/// The scan in the sensor's frame at its stamp. Who carves with it takes that frame's origin for
/// the start of every ray, which is off by the sensor's motion at most: the far end of the ray is
/// exact, and near the start, where the error is, the sensor itself passed through free space.
/// Where the sensor moved by more than `split_m` (0: never split) during the scan, it is cut into
/// parts of equal way, each in the sensor's frame at the middle of its own way. Points keep their
/// order; empty parts are left out; points that are not finite stay so. Throws
/// std::invalid_argument with a sentence if offsets and points differ in number, or if the path
/// does not reach over all points and the stamp.
std::vector<CompensatedScan> compensate_motion(const LidarScan& scan,
                                               const SensorPath& path,
                                               double split_m = 0.0,
                                               MotionReport* report = nullptr);

}  // namespace facet_mapping
