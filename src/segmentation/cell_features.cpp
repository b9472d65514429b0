// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace facet_mapping::detail {
namespace {

constexpr std::array<int, 3> kWindows{5, 15, 45};  // pixels of the resized image
constexpr int kDirections = 6;                     // of the gradient, over half a turn
constexpr int kContextPx = 60;                     // how far the neighbourhoods of a cell lie
constexpr int kContexts = 4;                       // above, below, left, right
constexpr int kPlainFeatures = 9 + 6 + 9 + 2 * (kDirections + 1) + 3 * kContexts + 2;
constexpr int kViewFeatures = 2;

cv::Mat box(const cv::Mat& image, int window) {
  cv::Mat mean;
  cv::blur(image, mean, {window, window}, {-1, -1}, cv::BORDER_REFLECT_101);
  return mean;
}

/// Collects planes, sampled at the cells' centres, as columns.
class Columns {
 public:
  Columns(const cv::Size& cells, int cell_px, int features)
      : cells_(cells),
        cell_px_(cell_px),
        table_(cells.area(), features, CV_32FC1, cv::Scalar(0.0)) {}

  /// The plane's value at each cell's centre, moved by (dx, dy) pixels and kept inside.
  void add(const cv::Mat& plane, int dx = 0, int dy = 0) {
    for (int y = 0; y < cells_.height; ++y) {
      const auto* row = plane.ptr<float>(std::clamp(center(y) + dy, 0, plane.rows - 1));
      for (int x = 0; x < cells_.width; ++x) {
        put(x, y, row[std::clamp(center(x) + dx, 0, plane.cols - 1)]);
      }
    }
    ++column_;
  }

  template <typename Function>
  void add_each(const Function& value_of_cell) {
    for (int y = 0; y < cells_.height; ++y) {
      for (int x = 0; x < cells_.width; ++x) {
        put(x, y, static_cast<float>(value_of_cell(x, y)));
      }
    }
    ++column_;
  }

  const cv::Mat& table() const { return table_; }

 private:
  int center(int cell) const { return cell * cell_px_ + cell_px_ / 2; }
  void put(int x, int y, float value) { table_.ptr<float>(y * cells_.width + x)[column_] = value; }

  cv::Size cells_;
  int cell_px_;
  int column_ = 0;
  cv::Mat table_;
};

/// Lab, CV_32FC1 each: L 0..100, a and b about -100..100.
std::vector<cv::Mat> lab_planes(const cv::Mat& bgr) {
  cv::Mat lab;
  bgr.convertTo(lab, CV_32F, 1.0 / 255.0);
  cv::cvtColor(lab, lab, cv::COLOR_BGR2Lab);
  std::vector<cv::Mat> planes;
  cv::split(lab, planes);
  return planes;
}

/// Mean colours in windows of three sizes, and how they differ from the next larger window.
void add_colors(const std::vector<cv::Mat>& lab, Columns* columns) {
  for (const cv::Mat& plane : lab) {
    std::array<cv::Mat, kWindows.size()> means;
    for (std::size_t k = 0; k < kWindows.size(); ++k) {
      means[k] = box(plane, kWindows[k]);
      columns->add(means[k]);
    }
    columns->add(means[0] - means[1]);
    columns->add(means[1] - means[2]);
    for (const auto& [dx, dy] : {std::pair(0, -1), {0, 1}, {-1, 0}, {1, 0}}) {
      columns->add(means[2], dx * kContextPx, dy * kContextPx);
    }
  }
}

/// Standard deviations of the colours in the windows.
void add_deviations(const std::vector<cv::Mat>& lab, Columns* columns) {
  for (const cv::Mat& plane : lab) {
    for (const int window : kWindows) {
      const cv::Mat mean = box(plane, window);
      cv::Mat variance = box(plane.mul(plane), window) - mean.mul(mean);
      cv::sqrt(cv::max(variance, 0.0), variance);
      columns->add(variance);
    }
  }
}

/// Magnitude of the gradient, put into the plane of its direction.
std::array<cv::Mat, kDirections> directed_gradients(const cv::Mat& lightness) {
  cv::Mat gx;
  cv::Mat gy;
  cv::Sobel(lightness, gx, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(lightness, gy, CV_32F, 0, 1, 3, 1.0 / 8.0);
  std::array<cv::Mat, kDirections> planes;
  for (cv::Mat& plane : planes) {
    plane = cv::Mat(lightness.size(), CV_32FC1, cv::Scalar(0.0));
  }
  for (int y = 0; y < lightness.rows; ++y) {
    const auto* x_row = gx.ptr<float>(y);
    const auto* y_row = gy.ptr<float>(y);
    for (int x = 0; x < lightness.cols; ++x) {
      const float half_turns = cv::fastAtan2(y_row[x], x_row[x]) / 180.0F;
      const int direction = static_cast<int>(half_turns * kDirections + 0.5F) % kDirections;
      planes[direction].ptr<float>(y)[x] = std::hypot(x_row[x], y_row[x]);
    }
  }
  return planes;
}

/// Histograms of gradient directions in the two larger windows, and the gradient's mean size.
void add_gradients(const cv::Mat& lightness, Columns* columns) {
  const std::array<cv::Mat, kDirections> planes = directed_gradients(lightness);
  for (std::size_t k = 1; k < kWindows.size(); ++k) {
    std::array<cv::Mat, kDirections> means;
    cv::Mat sum(lightness.size(), CV_32FC1, cv::Scalar(1e-3));
    for (int d = 0; d < kDirections; ++d) {
      means[d] = box(planes[d], kWindows[k]);
      sum += means[d];
    }
    for (const cv::Mat& mean : means) {
      columns->add(mean / sum);
    }
    columns->add(sum);
  }
}

/// How steeply the ray of each cell rises, and the ground's inverse distance along it.
void add_view(const GroundView& ground, const cv::Size& cells, Columns* columns) {
  const PinholeCamera camera = ground.view.camera.resized(cells.width, cells.height);
  const Eigen::Vector3d up_in_cam = ground.view.world_from_cam.linear().transpose() * ground.up;
  const double height_m = std::max(0.1, ground.up.dot(ground.view.center()) - ground.ground_m);
  const auto rise = [&](int x, int y) { return camera.ray({x, y}).normalized().dot(up_in_cam); };
  columns->add_each(rise);
  columns->add_each([&](int x, int y) { return std::max(0.0, -rise(x, y)) / height_m; });
}

}  // namespace

void check_cells(const CellConfig& config) {
  if (config.cell_px < 1 || config.cell_px > 64 || config.working_width < 8 * config.cell_px ||
      config.working_width > 8192) {
    throw std::invalid_argument(
        "A forest's cells must be 1 to 64 pixels wide, and the working width 8 cells to 8192 "
        "pixels");
  }
}

cv::Size cell_grid(const cv::Size& image, const CellConfig& config) {
  const double cell_px = config.cell_px;
  const int columns = static_cast<int>(std::lround(config.working_width / cell_px));
  const double rows = static_cast<double>(columns) * image.height / image.width;
  return {columns, std::clamp(static_cast<int>(std::lround(rows)), 1, 8 * columns)};
}

int feature_count(const CellConfig& config) {
  return kPlainFeatures + (config.use_view ? kViewFeatures : 0);
}

cv::Mat cell_features(const cv::Mat& bgr, const GroundView* ground, const CellConfig& config) {
  if (config.use_view && ground == nullptr) {
    throw std::invalid_argument(
        "This forest was trained with the cameras' poses, but the image comes without one; train "
        "it without them");
  }
  const cv::Size cells = cell_grid(bgr.size(), config);
  const cv::Size size = cells * config.cell_px;
  cv::Mat resized;
  cv::resize(
      bgr, resized, size, 0.0, 0.0, size.width < bgr.cols ? cv::INTER_AREA : cv::INTER_LINEAR);
  const std::vector<cv::Mat> lab = lab_planes(resized);
  Columns columns(cells, config.cell_px, feature_count(config));
  add_colors(lab, &columns);
  add_deviations(lab, &columns);
  add_gradients(lab[0], &columns);
  columns.add_each([&](int x, int /*y*/) { return (x + 0.5) / cells.width; });
  columns.add_each([&](int /*x*/, int y) { return (y + 0.5) / cells.height; });
  if (config.use_view) {
    add_view(*ground, cells, &columns);
  }
  return columns.table();
}

}  // namespace facet_mapping::detail
