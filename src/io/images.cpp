// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reading images, label images, depth images and scans with a sentence for each that is broken.
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/geometry/label.h"
#include "facet_mapping/io/dataset.h"

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

// The last bytes of a file, at most `count`.
std::string tail_of(const std::string& path, std::streamoff count) {
  std::ifstream input(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = input.tellg();
  const std::streamoff length = std::min(size, count);
  std::string tail(static_cast<std::size_t>(std::max<std::streamoff>(length, 0)), '\0');
  input.seekg(size - length);
  input.read(tail.data(), length);
  return tail;
}

// OpenCV fills the missing part of a truncated JPEG with grey and says nothing.
bool is_truncated(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  if (extension == ".png") {
    return tail_of(path, 12).find("IEND") == std::string::npos;
  }
  if (extension == ".jpg" || extension == ".jpeg" || extension == ".JPG") {
    return tail_of(path, 1024).find("\xFF\xD9") == std::string::npos;
  }
  return false;
}

cv::Mat decode(const std::string& path, int flags) {
  try {
    return cv::imread(path, flags | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

cv::Mat read_image(const std::string& path, int flags) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw std::runtime_error("the image '" + path + "' does not exist");
  }
  if (is_truncated(path)) {
    throw std::runtime_error("the image '" + path + "' is truncated (" +
                             std::to_string(fs::file_size(path, error)) +
                             " bytes without an end mark); copy it again");
  }
  cv::Mat image = decode(path, flags);
  if (image.empty()) {
    throw std::runtime_error("the image '" + path + "' is damaged or no image");
  }
  return image;
}

}  // namespace

cv::Mat read_gray(const std::string& path) {
  return read_image(path, cv::IMREAD_GRAYSCALE);
}

cv::Mat read_color(const std::string& path) {
  return read_image(path, cv::IMREAD_COLOR);
}

cv::Mat read_labels(const std::string& path) {
  const cv::Mat image = read_image(path, cv::IMREAD_UNCHANGED);
  if (image.type() != CV_8UC1 && image.type() != CV_16UC1) {
    throw std::runtime_error("the label image '" + path +
                             "' must hold class ids in one channel of 8 or 16 bits, not " +
                             std::to_string(image.channels()) + " channels");
  }
  cv::Mat labels;
  image.convertTo(labels, CV_16U);
  if (image.type() == CV_8UC1) {
    labels.setTo(cv::Scalar(kUnlabelled), image == 255);
  }
  return labels;
}

cv::Mat read_depth(const std::string& path, double scale) {
  const cv::Mat image = read_image(path, cv::IMREAD_UNCHANGED);
  if (image.type() != CV_16UC1) {
    throw std::runtime_error("the depth image '" + path + "' must have one channel of 16 bits");
  }
  cv::Mat depth;
  image.convertTo(depth, CV_32F, 1.0 / scale);
  return depth;
}

std::vector<Eigen::Vector4f> read_scan(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
  std::ifstream input(path, std::ios::binary);
  if (!input || bytes == 0 || bytes % sizeof(Eigen::Vector4f) != 0) {
    throw std::runtime_error(
        "the scan '" + path + "' has " + std::to_string(bytes) +
        " bytes; x y z intensity take 16 bytes a point (missing or truncated?)");
  }
  std::vector<Eigen::Vector4f> points(bytes / sizeof(Eigen::Vector4f));
  input.read(reinterpret_cast<char*>(points.data()), static_cast<std::streamsize>(bytes));
  if (!input) {
    throw std::runtime_error("the scan '" + path + "' cannot be read");
  }
  return points;
}

}  // namespace facet_mapping
