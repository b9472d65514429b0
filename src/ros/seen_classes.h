// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The classes that came against those that are configured, as texts for /diagnostics.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include <opencv2/core.hpp>

#include "facet_mapping/labels/label_image.h"
#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {

class SeenClasses {
 public:
  /// `labels` must outlive this.
  explicit SeenClasses(const LabelSet& labels) : labels_(labels) {}

  /// Counts a sample of the pixels of a decoded image (CV_16UC1), and all unknown ids.
  void add(const cv::Mat& ids, const LabelImageReport& report);

  /// "0 road 41.3 %, 10 sky 20.0 %, unlabelled 3.1 %".
  std::string seen() const;
  /// "31 (205 pixels), 77 (1000 pixels)"; empty if all ids are configured.
  std::string unknown() const;
  /// "0 road, 1 sidewalk".
  std::string configured() const;
  /// The configured classes that never came.
  std::string never_seen() const;

 private:
  const LabelSet& labels_;
  std::map<Label, std::size_t> pixels_;
  std::map<int, std::size_t> unknown_;
};

}  // namespace facet_mapping
