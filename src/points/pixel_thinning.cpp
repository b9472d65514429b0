// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pixel_thinning.h"

#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace facet_mapping::detail {
namespace {

/// A grid of cells over an image.
struct Grid {
  int cell_px;
  int columns;
  int rows;

  Grid(const cv::Size& size, int cell)
      : cell_px(cell),
        columns((size.width + cell - 1) / cell),
        rows((size.height + cell - 1) / cell) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y / cell_px) * columns + x / cell_px;
  }
  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
};

struct Best {
  float gradient = -1.0F;
  cv::Point pixel;
};

/// The usable pixel of strongest gradient in each cell; the first of equal ones.
std::vector<Best> best_per_cell(const cv::Mat& usable, const cv::Mat& gradient, const Grid& grid) {
  std::vector<Best> best(grid.size());
  for (int y = 0; y < usable.rows; ++y) {
    const auto* usable_row = usable.ptr<std::uint8_t>(y);
    const auto* gradient_row = gradient.ptr<float>(y);
    for (int x = 0; x < usable.cols; ++x) {
      Best& cell = best[grid.index(x, y)];
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
  cv::Sobel(gray, gx, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(gray, gy, CV_32F, 0, 1, 3, 1.0 / 8.0);
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
  const Grid flat_grid(usable.size(), config.flat_cell_px);
  std::vector<std::uint8_t> has_texture(flat_grid.size(), 0);
  std::vector<cv::Point> chosen;
  for (const Best& best : best_per_cell(usable, gradient, Grid(usable.size(), config.cell_px))) {
    if (best.gradient >= config.min_gradient) {
      chosen.push_back(best.pixel);
      has_texture[flat_grid.index(best.pixel.x, best.pixel.y)] = 1;
    }
  }
  const std::vector<Best> flat = best_per_cell(usable, gradient, flat_grid);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (has_texture[i] == 0 && flat[i].gradient >= 0.0F) {
      chosen.push_back(flat[i].pixel);
    }
  }
  return chosen;
}

}  // namespace facet_mapping::detail
