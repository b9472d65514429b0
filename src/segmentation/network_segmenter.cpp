// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/segmentation/network_segmenter.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "score_image.h"
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "facet_mapping/geometry/size_text.h"
#include "facet_mapping/labels/label_image.h"

namespace facet_mapping {
namespace {

constexpr int kStride = 32;   // most networks halve their input five times
constexpr int kVoidId = 255;  // of networks that give ids
constexpr int kMaxSize = 16384;

void check_config(const NetworkConfig& config) {
  const auto in_range = [](double size) { return size >= 1 && size <= kMaxSize; };
  if (!in_range(config.input_width) || !in_range(config.input_height)) {
    throw std::invalid_argument("The network's input size must be 1 to 16384 pixels each way");
  }
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(config.mean[c]) || !(config.deviation[c] > 0.0)) {
      throw std::invalid_argument("The network's means must be numbers, its deviations above 0");
    }
  }
  if (config.scales.empty() || !std::all_of(config.scales.begin(),
                                            config.scales.end(),
                                            [](double s) { return s >= 0.1 && s <= 10.0; })) {
    throw std::invalid_argument("The network's scales must be one or more numbers from 0.1 to 10");
  }
  if (!(config.min_confidence >= 0.0 && config.min_confidence <= 1.0)) {
    throw std::invalid_argument("The least confidence must lie between 0 and 1");
  }
}

/// Sizes that networks like stay such.
int scaled(int length, double scale) {
  const int step = length % kStride == 0 ? kStride : 1;
  return std::max(1, static_cast<int>(std::lround(length * scale / step))) * step;
}

std::string shape_text(const cv::Mat& output) {
  std::string text;
  for (int d = 0; d < output.dims; ++d) {
    text += (d > 0 ? " x " : "") + std::to_string(output.size[d]);
  }
  return text;
}

}  // namespace

/// The network, its input made and its output checked.
class NetworkSegmenter::Net {
 public:
  Net(const NetworkConfig& config, std::size_t classes) : config_(config), classes_(classes) {
    std::error_code not_needed;
    if (!std::filesystem::is_regular_file(config.model, not_needed)) {
      throw std::runtime_error("There is no network file '" + config.model +
                               "'; give the path of an ONNX file");
    }
    try {
      net_ = cv::dnn::readNetFromONNX(config.model);
      net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
      net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    } catch (const std::exception& error) {
      throw std::runtime_error("The file '" + config.model +
                               "' is not a network that OpenCV can read: it is damaged, truncated, "
                               "no ONNX, or has a layer that OpenCV lacks; export it again (" +
                               error.what() + ")");
    }
    if (net_.empty()) {
      throw std::runtime_error("The file '" + config.model +
                               "' holds no network; is it ONNX? Export it again");
    }
  }

  /// CV_32F, 1 x classes x h x w of scores or 1 x 1 x h x w of ids.
  cv::Mat forward(const cv::Mat& bgr, double scale) {
    const cv::Size size(scaled(config_.input_width, scale), scaled(config_.input_height, scale));
    cv::Mat output;
    try {
      net_.setInput(input_blob(bgr, size));
      output = (config_.output.empty() ? net_.forward() : net_.forward(config_.output)).clone();
    } catch (const std::exception& error) {
      throw std::runtime_error(
          "The network '" + config_.model + "' cannot be run on an input of " + size_text(size) +
          " pixels" + (config_.output.empty() ? "" : " for output '" + config_.output + "'") +
          "; set the input size that it was exported with (" + error.what() + ")");
    }
    return checked(output);
  }

 private:
  /// 1 x 3 x h x w, normalised.
  cv::Mat input_blob(const cv::Mat& bgr, const cv::Size& size) const {
    const bool shrinks = size.area() < bgr.size().area();
    cv::Mat resized;
    cv::resize(bgr, resized, size, 0.0, 0.0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    resized.convertTo(resized, CV_32F);
    const auto& m = config_.mean;
    const auto& d = config_.deviation;
    resized -= cv::Scalar(m[2], m[1], m[0]);
    cv::multiply(resized, cv::Scalar(1.0 / d[2], 1.0 / d[1], 1.0 / d[0]), resized);
    const bool swap = config_.channel_order == ChannelOrder::kRgb;
    return cv::dnn::blobFromImage(resized, 1.0, size, {}, swap, false, CV_32F);
  }

  cv::Mat checked(cv::Mat output) const {
    output.convertTo(output, CV_32F);
    if (output.dims == 3) {
      output = output.reshape(1, {output.size[0], 1, output.size[1], output.size[2]});
    }
    if (output.dims != 4 || output.size[0] != 1) {
      throw std::runtime_error("The network '" + config_.model + "' gives an output of shape " +
                               shape_text(output) +
                               "; segmentation needs 1 x classes x height x width or 1 x height x "
                               "width: choose another output or export it so");
    }
    if (output.size[1] != 1 && static_cast<std::size_t>(output.size[1]) != classes_) {
      throw std::runtime_error(
          "The network '" + config_.model + "' gives " + std::to_string(output.size[1]) +
          " classes, but " + std::to_string(classes_) +
          " are expected (the label list without ignored classes, or the class map); use its own "
          "label list or write a class map");
    }
    return output;
  }

  NetworkConfig config_;
  std::size_t classes_;
  cv::dnn::Net net_;
};

namespace {

Label label_of_id(float id, const std::vector<Label>& class_map, const std::string& model) {
  if (id >= 0.0F && id < static_cast<float>(class_map.size())) {
    return class_map[static_cast<std::size_t>(id)];
  }
  if (id == kVoidId) {
    return kUnlabelled;
  }
  throw std::runtime_error("The network '" + model + "' gives class " + std::to_string(id) +
                           ", but the label list (without ignored classes) or the class map has " +
                           std::to_string(class_map.size()) + "; use the network's own");
}

cv::Mat labels_of_ids(const cv::Mat& ids,
                      const cv::Size& size,
                      const std::vector<Label>& class_map,
                      const std::string& model) {
  cv::Mat labels(ids.size[2], ids.size[3], CV_16UC1);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      labels.at<Label>(y, x) = label_of_id(ids.ptr<float>(0, 0, y)[x], class_map, model);
    }
  }
  return resize_label_image(labels, size);
}

}  // namespace

NetworkSegmenter::NetworkSegmenter(const NetworkConfig& config, const LabelSet& labels)
    : Segmenter(config.min_confidence),
      config_(config),
      class_map_(read_class_map(config.class_map, labels)) {
  check_config(config);
  net_ = std::make_unique<Net>(config, class_map_.size());
  const cv::Mat blank(config.input_height, config.input_width, CV_8UC3, cv::Scalar::all(0.0));
  for (const double scale : config.scales) {
    net_->forward(blank, scale);
  }
}

NetworkSegmenter::~NetworkSegmenter() = default;

cv::Mat NetworkSegmenter::run(const cv::Mat& bgr,
                              const GroundView* /*ground*/,
                              cv::Mat* confidence) {
  std::vector<detail::ScoreGrid> grids;
  for (const double scale : config_.scales) {
    const cv::Mat output = net_->forward(bgr, scale);
    if (output.size[1] == 1 && class_map_.size() > 1) {  // ids: one scale says all
      *confidence = cv::Mat(bgr.size(), CV_32FC1, cv::Scalar(1.0));
      return labels_of_ids(output, bgr.size(), class_map_, config_.model);
    }
    grids.push_back(detail::make_score_grid(output));
  }
  return detail::most_likely_classes(grids, bgr.size(), class_map_, confidence);
}

}  // namespace facet_mapping
