// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/pictures.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "facet_mapping/labels/label_image.h"

namespace facet_mapping {
namespace {

const cv::Scalar kWhite(255, 255, 255);

// CV_8UC1 0..255 to colours.
cv::Mat colored(const cv::Mat& levels) {
  cv::Mat picture;
  cv::applyColorMap(levels, picture, cv::COLORMAP_TURBO);
  return picture;
}

}  // namespace

cv::Mat label_picture(const FacetImage& image, const TriangleMesh& mesh, const LabelSet& labels) {
  cv::Mat picture = color_label_image(label_image(image, mesh), labels);
  picture.setTo(kWhite, image.facets < 0);
  return picture;
}

DepthRange depth_range(const cv::Mat& depth) {
  std::vector<float> values;
  for (int row = 0; row < depth.rows; ++row) {
    const auto* pixels = depth.ptr<float>(row);
    std::copy_if(pixels, pixels + depth.cols, std::back_inserter(values), [](float value) {
      return value > 0.0F;
    });
  }
  if (values.empty()) {
    return {0.0, 1.0};
  }
  const auto percentile = [&values](std::size_t percent) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * percent / 100);
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
  };
  return {percentile(1), percentile(99)};
}

cv::Mat depth_picture(const cv::Mat& depth, const DepthRange& range) {
  if (depth.type() != CV_32FC1) {
    throw std::invalid_argument("depth picture: the depth image must be CV_32FC1");
  }
  const double near_log = std::log(std::max(range.near_m, 1e-3));
  const double span = std::max(std::log(std::max(range.far_m, 1e-3)) - near_log, 1e-6);
  cv::Mat logarithm;
  cv::log(cv::max(depth, 1e-6), logarithm);
  cv::Mat levels;
  logarithm.convertTo(levels, CV_8U, -255.0 / span, 255.0 + 255.0 * near_log / span);
  cv::Mat picture = colored(levels);
  picture.setTo(kWhite, depth <= 0.0F);
  return picture;
}

cv::Mat normal_picture(const FacetImage& image, const TriangleMesh& mesh, const View& view) {
  const std::vector<Eigen::Vector3d> normals = facet_normals(mesh);
  cv::Mat picture(image.facets.size(), CV_8UC3, kWhite);
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const int facet = image.facets.at<int>(row, column);
      if (facet < 0) {
        continue;
      }
      const Eigen::Vector3d ray =
          view.world_from_cam.linear() * view.camera.ray(Eigen::Vector2d(column, row));
      const Eigen::Vector3d& normal = normals.at(static_cast<std::size_t>(facet));
      const Eigen::Vector3d shown = normal.dot(ray) > 0.0 ? Eigen::Vector3d(-normal) : normal;
      for (int axis = 0; axis < 3; ++axis) {
        picture.at<cv::Vec3b>(row, column)[2 - axis] =
            cv::saturate_cast<unsigned char>(127.5 * (shown[axis] + 1.0));
      }
    }
  }
  return picture;
}

cv::Mat error_picture(const cv::Mat& rendered,
                      const cv::Mat& truth,
                      double max_error_m,
                      const cv::Mat& background) {
  if (rendered.type() != CV_32FC1 || truth.type() != CV_32FC1 || rendered.size() != truth.size() ||
      background.size() != truth.size() || !(max_error_m > 0.0)) {
    throw std::invalid_argument(
        "error picture: depth images must be CV_32FC1 of the background's size, the bound "
        "positive");
  }
  cv::Mat difference;
  cv::absdiff(rendered, truth, difference);
  cv::Mat levels;
  difference.convertTo(levels, CV_8U, 255.0 / max_error_m);
  cv::Mat is_true = truth > 0.0F;
  cv::Mat is_missing = is_true & (rendered <= 0.0F);
  levels.setTo(cv::Scalar(0), ~is_true);
  constexpr double kSparse = 0.2;  // share of pixels below which single pixels would not be seen
  if (cv::countNonZero(is_true) < kSparse * static_cast<double>(truth.total())) {
    const cv::Mat block = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
    for (cv::Mat* mask : {&levels, &is_true, &is_missing}) {
      cv::dilate(*mask, *mask, block);
    }
  }
  cv::Mat errors = colored(levels);
  errors.setTo(cv::Scalar(255, 0, 255), is_missing);
  cv::Mat gray;
  cv::cvtColor(background, gray, cv::COLOR_BGR2GRAY);
  cv::Mat picture;
  cv::cvtColor(gray * 0.5 + 127.0, picture, cv::COLOR_GRAY2BGR);
  errors.copyTo(picture, is_true);
  return picture;
}

cv::Mat overlay_picture(const cv::Mat& camera_image,
                        const FacetImage& image,
                        const TriangleMesh& mesh,
                        const LabelSet& labels,
                        double opacity) {
  if (camera_image.type() != CV_8UC3 || camera_image.size() != image.facets.size()) {
    throw std::invalid_argument(
        "overlay: the camera's image must be CV_8UC3 of the rendering's size");
  }
  const cv::Mat classes = label_image(image, mesh);
  cv::Mat blended;
  cv::addWeighted(
      color_label_image(classes, labels), opacity, camera_image, 1.0 - opacity, 0.0, blended);
  cv::Mat picture = camera_image.clone();
  blended.copyTo(picture, classes != kUnlabelled);
  return picture;
}

}  // namespace facet_mapping
