// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Labelled points of a dataset's frames, as the nodes would make them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "facet_mapping/io/dataset.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/points/labeled_point.h"
#include "facet_mapping/points/lidar_points.h"
#include "facet_mapping/points/sky_points.h"
#include "facet_mapping/points/stereo_points.h"
#include "facet_mapping/points/sweep_points.h"
#include "facet_mapping/points/track_points.h"

namespace facet_mapping {

struct DatasetPointsConfig {
  bool stereo = true;   ///< points of the stereo pair
  bool lidar = false;   ///< points of the scan
  bool tracks = false;  ///< points of features followed through the left images
  bool sweep = false;   ///< points of plane sweeping between the left images
  StereoConfig stereo_config;
  SkyConfig sky_config;
  CloudConfig cloud_config;
  TrackConfig track_config;
  SweepConfig sweep_config;
};

/// One sensor's points at one instant.
struct SensorPoints {
  std::string sensor;  ///< "stereo", "lidar", "tracks" or "sweep"
  PointFrame frame;
};

class DatasetPoints {
 public:
  /// Keeps a reference to the dataset. With an empty class list no point has a class; classes
  /// marked `sky` give no points. Throws std::invalid_argument if no source is wanted or the
  /// dataset lacks one that is.
  DatasetPoints(const Dataset& dataset, const LabelSet& labels, const DatasetPointsConfig& config);

  /// The points of a frame, one entry for each of stereo and scan that it has. Points take their
  /// class from the frame's label image, if there is one. Throws std::runtime_error on broken
  /// files.
  std::vector<SensorPoints> read(std::size_t frame) const;

  /// Feature tracks and plane sweeping know a frame's points only after the next ones: give the
  /// frames to follow() in the order of their stamps. It returns the points of earlier frames that
  /// are complete now, and the sky of this one. Nothing if neither is wanted. Throws as read()
  /// does.
  std::vector<SensorPoints> follow(std::size_t frame,
                                   TrackReport* tracks = nullptr,
                                   SweepReport* sweep = nullptr);

  /// The points of the frames that follow() still held back.
  std::vector<SensorPoints> finish();

 private:
  SensorPoints read_stereo(const DatasetFrame& frame, const cv::Mat& labels) const;
  SensorPoints read_lidar(const DatasetFrame& frame, const cv::Mat& labels) const;

  const Dataset& dataset_;
  LabelSet labels_;
  DatasetPointsConfig config_;
  FeatureTracker tracker_;
  PlaneSweeper sweeper_;
};

/// The frame's segmentation as CV_16UC1 ids of the class list, size of its camera; empty where the
/// frame has none or the class list is empty. Throws std::runtime_error naming a file that is
/// broken or holds no ids.
cv::Mat frame_label_image(const DatasetFrame& frame, const LabelSet& labels);

}  // namespace facet_mapping
