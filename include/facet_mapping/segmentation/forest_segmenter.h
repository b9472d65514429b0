// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentation without a network: a random forest, as the classical baselines have it.
#pragma once

#include <vector>

#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/segmentation/forest_model.h"
#include "facet_mapping/segmentation/segmenter.h"

namespace facet_mapping {

struct ForestSegmenterConfig {
  int smoothing_cells = 2;       ///< radius of the edge-preserving smoothing; 0: none
  double smoothing_edge = 0.05;  ///< grey steps (of 1) well above this keep their two sides apart
  double min_confidence = 0.0;   ///< less sure pixels become kUnlabelled
};

/// The forest answers per cell; the classes' probabilities are smoothed and brought to the pixels
/// by a guided filter (He et al. 2013) on the grey image, so that borders follow the image's.
class ForestSegmenter : public Segmenter {
 public:
  /// Throws std::runtime_error if a class of the model is not in the list under the same id and
  /// name, std::invalid_argument on settings that are out of range.
  ForestSegmenter(ForestModel model,
                  const LabelSet& labels,
                  const ForestSegmenterConfig& config = {});

 private:
  cv::Mat run(const cv::Mat& bgr, const GroundView* ground, cv::Mat* confidence) override;
  std::vector<cv::Mat> cell_probabilities(const cv::Mat& features, const cv::Size& cells) const;

  ForestModel model_;
  ForestSegmenterConfig config_;
};

}  // namespace facet_mapping
