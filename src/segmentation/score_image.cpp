// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "score_image.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace facet_mapping::detail {
namespace {

constexpr float kSumTolerance = 1e-3F;

/// Where a pixel lies between two cells of a grid.
struct Blend {
  int low = 0;
  int high = 0;
  float share = 0.0F;  // of high
};

Blend blend_at(int pixel, int pixels, int cells) {
  const double at = (pixel + 0.5) * cells / pixels - 0.5;
  const double clamped = std::clamp(at, 0.0, static_cast<double>(cells - 1));
  const int low = static_cast<int>(clamped);
  return {low, std::min(low + 1, cells - 1), static_cast<float>(clamped - low)};
}

std::vector<Blend> blend_table(int pixels, int cells) {
  std::vector<Blend> table(static_cast<std::size_t>(pixels));
  for (int k = 0; k < pixels; ++k) {
    table[k] = blend_at(k, pixels, cells);
  }
  return table;
}

/// Rows of one image row: values[class * width + x].
using ClassRows = std::vector<float>;

void interpolate_row(const ScoreGrid& grid,
                     const Blend& row,
                     const std::vector<Blend>& columns,
                     ClassRows* values) {
  const std::size_t width = columns.size();
  std::vector<float> line(static_cast<std::size_t>(grid.width()));
  for (int c = 0; c < grid.classes(); ++c) {
    const auto* low = grid.scores.ptr<float>(0, c, row.low);
    const auto* high = grid.scores.ptr<float>(0, c, row.high);
    for (std::size_t k = 0; k < line.size(); ++k) {
      line[k] = low[k] + row.share * (high[k] - low[k]);
    }
    float* target = values->data() + static_cast<std::size_t>(c) * width;
    for (std::size_t x = 0; x < width; ++x) {
      const Blend& column = columns[x];
      target[x] = line[column.low] + column.share * (line[column.high] - line[column.low]);
    }
  }
}

void softmax(std::size_t width, int classes, ClassRows* values) {
  for (std::size_t x = 0; x < width; ++x) {
    float largest = (*values)[x];
    for (int c = 1; c < classes; ++c) {
      largest = std::max(largest, (*values)[c * width + x]);
    }
    float sum = 0.0F;
    for (int c = 0; c < classes; ++c) {
      float& value = (*values)[c * width + x];
      value = std::exp(value - largest);
      sum += value;
    }
    for (int c = 0; c < classes; ++c) {
      (*values)[c * width + x] /= sum;
    }
  }
}

void take_most_likely(const ClassRows& sums,
                      float weight,
                      const std::vector<Label>& class_map,
                      cv::Mat* labels,
                      cv::Mat* confidence,
                      int y) {
  const auto width = static_cast<std::size_t>(labels->cols);
  for (std::size_t x = 0; x < width; ++x) {
    std::size_t best = 0;
    for (std::size_t c = 1; c < class_map.size(); ++c) {
      best = sums[c * width + x] > sums[best * width + x] ? c : best;
    }
    const float probability = weight * sums[best * width + x];
    const bool is_number = std::isfinite(probability);  // not so where the network overflows
    labels->ptr<Label>(y)[x] = is_number ? class_map[best] : kUnlabelled;
    confidence->ptr<float>(y)[x] = is_number ? probability : 0.0F;
  }
}

}  // namespace

ScoreGrid make_score_grid(const cv::Mat& scores) {
  ScoreGrid grid{scores, true};
  const int cells = grid.height() * grid.width();
  for (int k = 0; k < cells && grid.is_probability; ++k) {
    float sum = 0.0F;
    for (int c = 0; c < grid.classes(); ++c) {
      const float score = scores.ptr<float>(0, c)[k];
      grid.is_probability = grid.is_probability && score >= 0.0F;
      sum += score;
    }
    grid.is_probability = grid.is_probability && std::abs(sum - 1.0F) < kSumTolerance;
  }
  return grid;
}

cv::Mat most_likely_classes(const std::vector<ScoreGrid>& grids,
                            const cv::Size& size,
                            const std::vector<Label>& class_map,
                            cv::Mat* confidence) {
  cv::Mat labels(size, CV_16UC1);
  confidence->create(size, CV_32FC1);
  std::vector<std::vector<Blend>> columns;
  std::vector<std::vector<Blend>> rows;
  for (const ScoreGrid& grid : grids) {
    columns.push_back(blend_table(size.width, grid.width()));
    rows.push_back(blend_table(size.height, grid.height()));
  }
  const int classes = static_cast<int>(class_map.size());
  const auto width = static_cast<std::size_t>(size.width);
  cv::parallel_for_(cv::Range(0, size.height), [&](const cv::Range& range) {
    ClassRows values(class_map.size() * width);
    for (int y = range.start; y < range.end; ++y) {
      ClassRows sums(values.size(), 0.0F);
      for (std::size_t g = 0; g < grids.size(); ++g) {
        interpolate_row(grids[g], rows[g][y], columns[g], &values);
        if (!grids[g].is_probability) {
          softmax(width, classes, &values);
        }
        std::transform(sums.begin(), sums.end(), values.begin(), sums.begin(), std::plus<>());
      }
      take_most_likely(
          sums, 1.0F / static_cast<float>(grids.size()), class_map, &labels, confidence, y);
    }
  });
  return labels;
}

}  // namespace facet_mapping::detail
