// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/image_conversions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <cv_bridge/cv_bridge.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sensor_msgs/image_encodings.h>

namespace facet_mapping {
namespace {

namespace encodings = sensor_msgs::image_encodings;

std::invalid_argument problem(const std::string& topic, const std::string& sentence) {
  return std::invalid_argument("'" + topic + "': " + sentence);
}

/// A view on the message's pixels, without conversion; checks that they are there.
cv::Mat pixels(const sensor_msgs::Image& image, const std::string& topic) {
  if (image.width == 0 || image.height == 0) {
    throw problem(topic, "the image is empty (0 pixels); check its source");
  }
  if (image.data.size() != static_cast<std::size_t>(image.step) * image.height) {
    throw problem(topic,
                  "the image holds " + std::to_string(image.data.size()) + " bytes, but step * " +
                      "height is " + std::to_string(image.step * image.height) +
                      "; the message is damaged or truncated");
  }
  const boost::shared_ptr<const void> untracked;
  return cv_bridge::toCvShare(image, untracked)->image;
}

bool is_gray_source(const std::string& encoding) {
  return encodings::isMono(encoding) || encodings::isColor(encoding) ||
         encodings::isBayer(encoding);
}

bool has_png_signature(const std::vector<std::uint8_t>& data) {
  static const std::vector<std::uint8_t> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  return data.size() >= kSignature.size() &&
         std::equal(kSignature.begin(), kSignature.end(), data.begin());
}

std::string encoding_of(const cv::Mat& image, const std::string& topic) {
  switch (image.type()) {
    case CV_8UC1:
      return encodings::MONO8;
    case CV_16UC1:
      return encodings::MONO16;
    case CV_8UC3:
      return encodings::BGR8;
    default:
      throw problem(topic,
                    "the PNG is neither 8-bit nor 16-bit grey (class ids) nor 8-bit colour; "
                    "write one of these");
  }
}

/// The value that means certainty in a confidence image.
double certainty(const sensor_msgs::Image& image, const std::string& topic) {
  if (image.encoding == encodings::MONO8 || image.encoding == encodings::TYPE_8UC1) {
    return 255.0;
  }
  if (image.encoding == encodings::MONO16 || image.encoding == encodings::TYPE_16UC1) {
    return 65535.0;
  }
  if (image.encoding == encodings::TYPE_32FC1) {
    return 1.0;
  }
  throw problem(topic,
                "encoding '" + image.encoding +
                    "' is no confidence; publish mono8 (255 is certain), mono16 or 32FC1 (0 to 1)");
}

}  // namespace

cv::Mat gray_from_message(const sensor_msgs::Image& image, const std::string& topic) {
  try {
    const cv::Mat raw = pixels(image, topic);
    if (image.encoding == encodings::MONO8 || image.encoding == encodings::TYPE_8UC1) {
      return raw.clone();
    }
    if (!is_gray_source(image.encoding)) {
      throw problem(topic,
                    "encoding '" + image.encoding +
                        "' is not an image that can be turned grey; publish mono8, rgb8 or bgr8");
    }
    return cv_bridge::toCvCopy(image, encodings::MONO8)->image;
  } catch (const cv_bridge::Exception& e) {
    throw problem(topic, std::string(e.what()) + "; publish mono8, rgb8 or bgr8");
  } catch (const cv::Exception& e) {
    throw problem(topic, std::string("the image cannot be converted to grey: ") + e.what());
  }
}

cv::Mat labels_from_message(const sensor_msgs::Image& image,
                            const LabelSet& labels,
                            const std::string& topic,
                            LabelImageReport* report) {
  if (image.encoding.empty()) {
    throw problem(topic, "the label image has no encoding; publish mono8 class ids");
  }
  try {
    return decode_label_image(pixels(image, topic), image.encoding, labels, report);
  } catch (const cv_bridge::Exception& e) {
    throw problem(topic, std::string(e.what()) + "; publish mono8 class ids");
  } catch (const std::invalid_argument& e) {
    throw problem(topic, e.what());
  }
}

cv::Mat labels_from_message(const sensor_msgs::CompressedImage& image,
                            const LabelSet& labels,
                            const std::string& topic,
                            LabelImageReport* report) {
  if (!has_png_signature(image.data)) {
    throw problem(topic,
                  "the label image (format '" + image.format +
                      "') is not PNG; lossy compression invents classes at every border, so only "
                      "PNG is accepted");
  }
  const cv::Mat decoded = cv::imdecode(image.data, cv::IMREAD_UNCHANGED);
  if (decoded.empty()) {
    throw problem(topic, "the PNG label image cannot be decoded; it is damaged or truncated");
  }
  try {
    return decode_label_image(decoded, encoding_of(decoded, topic), labels, report);
  } catch (const std::invalid_argument& e) {
    throw problem(topic, e.what());
  }
}

cv::Mat confidence_from_message(const sensor_msgs::Image& image, const std::string& topic) {
  const double certain = certainty(image, topic);
  cv::Mat confidence;
  pixels(image, topic).convertTo(confidence, CV_32F, 1.0 / certain);
  return confidence;
}

void hide_unsure_pixels(const cv::Mat& confidence, double min_confidence, cv::Mat* labels) {
  cv::Mat fitting = confidence;
  if (confidence.size() != labels->size()) {
    cv::resize(confidence, fitting, labels->size(), 0.0, 0.0, cv::INTER_NEAREST);
  }
  const cv::Mat is_sure = fitting >= min_confidence;  // false for what is not a number
  labels->setTo(kUnlabelled, ~is_sure);
}

}  // namespace facet_mapping
