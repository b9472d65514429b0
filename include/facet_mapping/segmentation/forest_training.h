// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Trains a forest on a few label images.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/segmentation/forest_model.h"
#include "facet_mapping/segmentation/segmenter.h"

namespace facet_mapping {

struct ForestTrainingConfig {
  CellConfig cells;
  int trees = 60;
  int max_depth = 20;
  int min_leaf_samples = 6;    ///< cells that a node must have to be split further
  int max_samples = 60000;     ///< cells in all, drawn at random
  double class_balance = 0.5;  ///< 0: classes as frequent as in the images, 1: all alike
  std::uint64_t seed = 1;
};

struct TrainingImage {
  cv::Mat bgr;     ///< CV_8UC3
  cv::Mat labels;  ///< CV_16UC1 of its size; kUnlabelled teaches nothing
  std::optional<GroundView> ground;
};

/// Same images and settings, same model. Throws std::invalid_argument if the images do not fit, a
/// label is not in the list, fewer than two classes are shown, or a setting is out of range.
ForestModel train_forest(const std::vector<TrainingImage>& images,
                         const LabelSet& labels,
                         const ForestTrainingConfig& config);

}  // namespace facet_mapping
