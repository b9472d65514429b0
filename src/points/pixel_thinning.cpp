// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pixel_thinning.h"

#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping::detail {
namespace {

struct Best {
  float gradient = -1.0F;
  cv::Point pixel;
};

/// The usable pixel of strongest gradient in each cell; the first of equal ones. `may_be(cell, x,
/// y)` can refuse pixels.
template <typename MayBe>
std::vector<Best> best_per_cell(const cv::Mat& usable,
                                const cv::Mat& gradient,
                                int cell_px,
                                const MayBe& may_be) {
  const int columns = (usable.cols + cell_px - 1) / cell_px;
  const int rows = (usable.rows + cell_px - 1) / cell_px;
  std::vector<Best> best(static_cast<std::size_t>(columns) * rows);
  for (int y = 0; y < usable.rows; ++y) {
    const auto* usable_row = usable.ptr<std::uint8_t>(y);
    const auto* gradient_row = gradient.ptr<float>(y);
    const std::size_t first_cell = static_cast<std::size_t>(y / cell_px) * columns;
    for (int x = 0; x < usable.cols; ++x) {
      const std::size_t cell = first_cell + static_cast<std::size_t>(x / cell_px);
      if (usable_row[x] != 0 && gradient_row[x] > best[cell].gradient && may_be(cell, x, y)) {
        best[cell] = {gradient_row[x], {x, y}};
      }
    }
  }
  return best;
}

std::vector<Best> best_per_cell(const cv::Mat& usable, const cv::Mat& gradient, int cell_px) {
  return best_per_cell(usable, gradient, cell_px, [](std::size_t, int, int) { return true; });
}

/// The same among the pixels of another class than the best's.
std::vector<Best> best_of_another_class(const cv::Mat& usable,
                                        const cv::Mat& gradient,
                                        const cv::Mat& labels,
                                        int cell_px,
                                        const std::vector<Best>& best) {
  return best_per_cell(usable, gradient, cell_px, [&](std::size_t cell, int x, int y) {
    return labels.at<Label>(y, x) != labels.at<Label>(best[cell].pixel);
  });
}

cv::Rect cell_around(const cv::Point& pixel, int cell_px, const cv::Size& size) {
  return cv::Rect(pixel.x / cell_px * cell_px, pixel.y / cell_px * cell_px, cell_px, cell_px) &
         cv::Rect({0, 0}, size);
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
                                   const ThinningConfig& config,
                                   const cv::Mat& labels) {
  const std::vector<Best> best = best_per_cell(usable, gradient, config.cell_px);
  std::vector<Best> other(best.size());
  if (!labels.empty()) {
    other = best_of_another_class(usable, gradient, labels, config.cell_px, best);
  }
  std::vector<cv::Point> chosen;
  cv::Mat rest = usable.clone();
  for (std::size_t i = 0; i < best.size(); ++i) {
    const bool is_border = other[i].gradient >= 0.0F;
    if (is_border || best[i].gradient >= config.min_gradient) {
      chosen.push_back(best[i].pixel);
    }
    if (is_border) {
      chosen.push_back(other[i].pixel);
      rest(cell_around(best[i].pixel, config.cell_px, usable.size())) = 0;
    }
  }
  for (const Best& flat : best_per_cell(rest, gradient, config.flat_cell_px)) {
    if (flat.gradient >= 0.0F && flat.gradient < config.min_gradient) {
      chosen.push_back(flat.pixel);
    }
  }
  return chosen;
}

}  // namespace facet_mapping::detail
