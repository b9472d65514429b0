// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The images that a refinement can use: chosen by motion, bounded in number and memory.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "facet_mapping/labels/labeled_view.h"

namespace facet_mapping {

struct KeyframeLimits {
  double translation_m = 0.5;
  double rotation_deg = 10.0;
  std::size_t max_count = 500;
  std::size_t max_bytes = std::size_t{2048} << 20;
};

/// Thread-safe. The images inside are shared, never changed.
class KeyframeStore {
 public:
  explicit KeyframeStore(const KeyframeLimits& limits) : limits_(limits) {}

  /// True if a camera at this pose is far enough from the last keyframe.
  bool wants(const Eigen::Isometry3d& world_from_cam) const;
  /// Adds a keyframe; returns how many old ones had to go.
  std::size_t add(LabeledView view);

  std::vector<LabeledView> views() const;
  std::optional<LabeledView> newest() const;
  std::size_t size() const;
  std::size_t bytes() const;
  /// Keyframes with a segmentation.
  std::size_t labelled() const;
  void clear();

 private:
  KeyframeLimits limits_;
  mutable std::mutex mutex_;
  std::deque<LabeledView> views_;
  std::size_t bytes_ = 0;
};

}  // namespace facet_mapping
