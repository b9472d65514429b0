// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One scan with all that belongs to it -> labelled points. Without ROS's graph.
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"
#include "facet_mapping/points/lidar_motion.h"
#include "facet_mapping/points/lidar_scan.h"
#include "facet_mapping/ros/lidar_points_node_config.h"

namespace facet_mapping {

/// A scan, the way of its sensor, and the label image nearest to it.
struct LidarJob {
  LidarScan scan;
  std::vector<StampedPose> map_from_sensor;
  cv::Mat labels;  ///< CV_16UC1; empty: the points stay unlabelled
  View camera;     ///< of the labels, at their own stamp
};

/// Numbers of one job.
struct LidarJobReport {
  MotionReport motion;
  CloudReport cloud;
  std::size_t labelled = 0;
};

/// All calls in one thread.
class LidarPointsWorker {
 public:
  explicit LidarPointsWorker(const LidarPointsNodeConfig& config) : config_(config) {}

  /// Motion compensated, cleaned, thinned, labelled: one frame or, of a long way, several; none
  /// empty. Throws std::invalid_argument if the poses do not reach over the scan.
  std::vector<PointFrame> work(const LidarJob& job, LidarJobReport* report);
  /// Forgets earlier scans.
  void clear() { earlier_.clear(); }

 private:
  PointFrame clean(const CompensatedScan& scan,
                   std::vector<LabeledPoint>* dense,
                   CloudReport* report) const;
  std::size_t label(const LidarJob& job, const std::vector<LabeledPoint>& dense, PointFrame* frame);
  void remember(std::vector<LabeledPoint> dense, const Eigen::Isometry3d& map_from_sensor);

  struct Earlier {
    std::vector<LabeledPoint> points;
    Eigen::Isometry3d map_from_sensor;
  };

  LidarPointsNodeConfig config_;
  std::deque<Earlier> earlier_;
};

}  // namespace facet_mapping
