// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/image_pyramid.h"

#include <algorithm>
#include <map>

#include <opencv2/imgproc.hpp>

namespace facet_mapping {
namespace {

/// First source pixel that belongs to target pixel `k` of `count`.
int block_begin(int k, int count, int source) {
  return static_cast<int>(static_cast<long long>(k) * source / count);
}

Label majority(const cv::Mat& block) {
  std::map<Label, int> votes;
  for (int y = 0; y < block.rows; ++y) {
    for (int x = 0; x < block.cols; ++x) {
      ++votes[block.at<Label>(y, x)];
    }
  }
  const auto best = std::max_element(
      votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return best->first;
}

}  // namespace

cv::Mat shrink_labels(const cv::Mat& labels, const cv::Size& size) {
  cv::Mat small(size, CV_16UC1);
  for (int y = 0; y < size.height; ++y) {
    const cv::Range rows(block_begin(y, size.height, labels.rows),
                         block_begin(y + 1, size.height, labels.rows));
    for (int x = 0; x < size.width; ++x) {
      const cv::Range cols(block_begin(x, size.width, labels.cols),
                           block_begin(x + 1, size.width, labels.cols));
      small.at<Label>(y, x) = majority(labels(rows, cols));
    }
  }
  return small;
}

LabeledView shrink_view(const LabeledView& view, int level) {
  if (level <= 0) {
    return view;
  }
  const int factor = 1 << level;
  const cv::Size size(std::max(1, (view.view.camera.width + factor / 2) / factor),
                      std::max(1, (view.view.camera.height + factor / 2) / factor));
  LabeledView small = view;
  small.view.camera = view.view.camera.resized(size.width, size.height);
  cv::resize(view.gray, small.gray, size, 0.0, 0.0, cv::INTER_AREA);
  if (!view.labels.empty()) {
    small.labels = shrink_labels(view.labels, size);
  }
  return small;
}

}  // namespace facet_mapping
