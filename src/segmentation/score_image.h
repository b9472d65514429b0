// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Class scores of a network on a grid, brought to the pixels of an image.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping::detail {

/// One output of the network: CV_32F, 1 x classes x h x w.
struct ScoreGrid {
  cv::Mat scores;
  bool is_probability = false;  ///< not negative, and the classes of each cell sum to 1

  int classes() const { return scores.size[1]; }
  int height() const { return scores.size[2]; }
  int width() const { return scores.size[3]; }
};

/// Finds out whether the scores are probabilities already.
ScoreGrid make_score_grid(const cv::Mat& scores);

/// The most likely class of each pixel and its probability (CV_32FC1): the scores of each grid are
/// interpolated bilinearly (pixel areas are kept), turned into probabilities by softmax unless they
/// are, and averaged over the grids. `class_map`: channel -> id.
cv::Mat most_likely_classes(const std::vector<ScoreGrid>& grids,
                            const cv::Size& size,
                            const std::vector<Label>& class_map,
                            cv::Mat* confidence);

}  // namespace facet_mapping::detail
