// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentation by a network from an ONNX file, run by OpenCV's dnn module on the CPU.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/segmentation/segmenter.h"

namespace facet_mapping {

/// Which way round the network wants the colour channels.
enum class ChannelOrder { kRgb, kBgr };

struct NetworkConfig {
  std::string model;       ///< path of the ONNX file
  int input_width = 1024;  ///< pixels; the image is resized to this
  int input_height = 512;  ///< pixels
  /// The network sees (value - mean) / deviation of 8-bit values; red, green, blue whatever the
  /// channel order. Defaults: those of ImageNet.
  std::array<double, 3> mean{123.675, 116.28, 103.53};
  std::array<double, 3> deviation{58.395, 57.12, 57.375};
  ChannelOrder channel_order = ChannelOrder::kRgb;
  std::string output;               ///< name of the output, empty: the first
  std::string class_map;            ///< YAML file (see read_class_map), empty: the list's order
  std::vector<double> scales{1.0};  ///< of the input size; probabilities are averaged over them
  double min_confidence = 0.0;      ///< less sure pixels become kUnlabelled
};

/// Channel k of a network -> class id. Without a file: the classes of the list that are not
/// ignored, by ascending ids (for Cityscapes the 19 train ids). The file holds
/// `classes: [0, 1, 2, none, 8]`, an id or "none" for each channel. Throws std::runtime_error on a
/// file that is not so, or that names classes the list does not have.
std::vector<Label> read_class_map(const std::string& path, const LabelSet& labels);

/// The output may be scores or probabilities, N x classes x h x w, or ids, N x h x w or
/// N x 1 x h x w, of any size h x w. Scores are brought to the image's size bilinearly before the
/// most likely class is taken; ids by the nearest pixel.
class NetworkSegmenter : public Segmenter {
 public:
  /// Runs the network once on an empty image of each scale, so that a file that is no network, an
  /// input size that it refuses or a wrong number of classes are told at once: std::runtime_error.
  /// Throws std::invalid_argument on settings that are out of range.
  NetworkSegmenter(const NetworkConfig& config, const LabelSet& labels);
  ~NetworkSegmenter() override;

 private:
  class Net;

  cv::Mat run(const cv::Mat& bgr, const GroundView* ground, cv::Mat* confidence) override;

  NetworkConfig config_;
  std::vector<Label> class_map_;
  std::unique_ptr<Net> net_;
};

}  // namespace facet_mapping
