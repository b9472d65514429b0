// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rectified pairs of planes with known disparity.
#pragma once

#include <random>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace facet_mapping::test {

/// Columns of the fine texture per pixel, so that images shifted by parts of a pixel are exact.
constexpr int kFineness = 8;

/// Random grey texture, a few pixels fine and kFineness times as wide as the images; repeatable.
inline cv::Mat make_fine_texture(int width, int height, unsigned seed) {
  cv::Mat noise(height, kFineness * width, CV_32F);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1.0F, 1.0F);
  for (auto& pixel : cv::Mat_<float>(noise)) {
    pixel = value(random);
  }
  cv::GaussianBlur(noise, noise, {0, 0}, 1.2 * kFineness, 1.2);
  cv::Mat texture;
  noise.convertTo(texture, CV_8U, 850.0, 128.0);
  return texture;
}

/// Disparity of the left image's pixels on a plane: at_origin + per_x * x + per_y * y.
struct DisparityPlane {
  double at_origin = 0.0;
  double per_x = 0.0;
  double per_y = 0.0;

  double at(double x, double y) const { return at_origin + per_x * x + per_y * y; }
};

/// What a camera sees of a plane that carries a fine texture, whose column 0 is at x = 0 of the
/// left image. Disparity 0 gives the left image.
inline cv::Mat make_image(const cv::Mat& fine_texture, const DisparityPlane& plane) {
  cv::Mat map_x(fine_texture.rows, fine_texture.cols / kFineness, CV_32F);
  cv::Mat map_y(map_x.size(), CV_32F);
  for (int y = 0; y < map_x.rows; ++y) {
    for (int x = 0; x < map_x.cols; ++x) {
      // x = x_left - d(x_left, y), solved for x_left.
      const double x_left = (x + plane.at(0.0, y)) / (1.0 - plane.per_x);
      map_x.at<float>(y, x) = static_cast<float>(kFineness * x_left);
      map_y.at<float>(y, x) = static_cast<float>(y);
    }
  }
  cv::Mat image;
  cv::remap(fine_texture, image, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REFLECT_101);
  return image;
}

struct StereoPair {
  cv::Mat left;
  cv::Mat right;
};

inline StereoPair make_pair(int width, int height, unsigned seed, const DisparityPlane& plane) {
  const cv::Mat texture = make_fine_texture(width, height, seed);
  return {make_image(texture, {}), make_image(texture, plane)};
}

inline cv::Mat make_texture(int width, int height, unsigned seed) {
  return make_image(make_fine_texture(width, height, seed), {});
}

}  // namespace facet_mapping::test
