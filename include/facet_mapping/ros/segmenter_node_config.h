// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters of the segmenter node.
#pragma once

#include <string>
#include <vector>

#include "facet_mapping/ros/parameters.h"
#include "facet_mapping/segmentation/forest_segmenter.h"
#include "facet_mapping/segmentation/network_segmenter.h"

namespace facet_mapping {

enum class SegmenterBackend { kNetwork, kForest };

struct SegmenterNodeConfig {
  std::string label_file = "cityscapes";
  SegmenterBackend backend = SegmenterBackend::kNetwork;
  std::string model;  ///< ONNX file, or what train_segmenter wrote
  double min_confidence = 0.0;
  double max_rate_hz = 0.0;  ///< by the images' stamps; 0: all
  int queue_size = 2;        ///< images that may wait; then the oldest is dropped
  NetworkConfig network;
  std::vector<std::string> scales{"1.0"};  ///< of the network's input
  ForestSegmenterConfig forest;
};

/// The table points into the struct, which must outlive it.
ParameterTable parameter_table(SegmenterNodeConfig* config);

/// Numbers from texts. Throws std::invalid_argument on a text that is no number.
std::vector<double> numbers_from(const std::vector<std::string>& texts);

}  // namespace facet_mapping
