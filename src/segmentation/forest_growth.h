// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// OpenCV's random trees, grown and carried over into our model.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/segmentation/forest_training.h"

namespace facet_mapping::detail {

struct TrainingTable {
  cv::Mat features;          ///< CV_32FC1, one row per sample
  std::vector<int> classes;  ///< of each sample: index into the model's classes
};

/// Fills nodes, roots and leaves; a leaf holds the shares of the samples that fall into it.
void grow_forest(const TrainingTable& table,
                 const ForestTrainingConfig& config,
                 ForestModel* model);

}  // namespace facet_mapping::detail
