// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pixel_thinning.h"

#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace facet_mapping::detail {
namespace {

struct Best {
  float gradient = -1.0F;
  cv::Point pixel;
};

/// The usable pixel of strongest gradient in each cell; the first of equal ones.
std::vector<Best> best_per_cell(const cv::Mat& usable, const cv::Mat& gradient, int cell_px) {
  const int columns = (usable.cols + cell_px - 1) / cell_px;
  const int rows = (usable.rows + cell_px - 1) / cell_px;
  std::vector<Best> best(static_cast<std::size_t>(columns) * rows);
  for (int y = 0; y < usable.rows; ++y) {
    const auto* usable_row = usable.ptr<std::uint8_t>(y);
    const auto* gradient_row = gradient.ptr<float>(y);
    Best* cells = best.data() + static_cast<std::ptrdiff_t>(y / cell_px) * columns;
    for (int x = 0; x < usable.cols; ++x) {
      Best& cell = cells[x / cell_px];
      if (usable_row[x] != 0 && gradient_row[x] > cell.gradient) {
        cell = {gradient_row[x], {x, y}};
      }
    }
  }
  return best;
}

}  // namespace

cv::Mat gradient_magnitude(const cv::Mat& gray) {
  cv::Mat gx;
  cv::Mat gy;
  constexpr int kBorder = cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED;
  cv::Sobel(gray, gx, CV_32F, 1, 0, 3, 1.0 / 8.0, 0.0, kBorder);
  cv::Sobel(gray, gy, CV_32F, 0, 1, 3, 1.0 / 8.0, 0.0, kBorder);
  cv::Mat magnitude;
  cv::magnitude(gx, gy, magnitude);
  return magnitude;
}

cv::Mat find_depth_edges(const cv::Mat& disparity, double jump_px, int margin_px) {
  cv::Mat edges(disparity.size(), CV_8UC1, cv::Scalar(0));
  const auto jump = static_cast<float>(jump_px);
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* row = disparity.ptr<float>(y);
    const auto* below = disparity.ptr<float>(std::min(y + 1, disparity.rows - 1));
    auto* edge_row = edges.ptr<std::uint8_t>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      const float right = row[std::min(x + 1, disparity.cols - 1)];
      // Written so that NaN, a hole, counts as an edge.
      const bool smooth = std::abs(right - row[x]) <= jump && std::abs(below[x] - row[x]) <= jump;
      edge_row[x] = smooth ? 0 : 255;
    }
  }
  if (margin_px > 0) {
    const int side = 2 * margin_px + 1;
    cv::dilate(edges, edges, cv::Mat::ones(side, side, CV_8UC1));
  }
  return edges;
}

std::vector<cv::Point> thin_pixels(const cv::Mat& usable,
                                   const cv::Mat& gradient,
                                   const ThinningConfig& config) {
  std::vector<cv::Point> chosen;
  for (const Best& best : best_per_cell(usable, gradient, config.cell_px)) {
    if (best.gradient >= config.min_gradient) {
      chosen.push_back(best.pixel);
    }
  }
  for (const Best& best : best_per_cell(usable, gradient, config.flat_cell_px)) {
    if (best.gradient >= 0.0F && best.gradient < config.min_gradient) {
      chosen.push_back(best.pixel);
    }
  }
  return chosen;
}

}  // namespace facet_mapping::detail
