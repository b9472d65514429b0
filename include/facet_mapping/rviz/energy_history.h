// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The energies of a running refinement, iteration by iteration, and the axis to plot them on.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <facet_mapping/RefineProgress.h>

namespace facet_mapping {

/// What was told of one job. Energies of different levels are not comparable: each level is
/// measured on images of its own size.
class EnergyHistory {
 public:
  /// What is not further than the sample before is the first of another job. True if so.
  bool add(const RefineProgress& sample);
  void clear() { samples_.clear(); }

  const std::vector<RefineProgress>& samples() const { return samples_; }

  struct Stretch {
    int level = 0;          ///< 0 = the finest
    std::size_t begin = 0;  ///< of samples()
    std::size_t end = 0;    ///< one past the last
  };
  /// In the order of time; neighbours differ in their level.
  std::vector<Stretch> levels() const;

  /// Places on an axis of iterations: as many as the job seems to need in the end, but never so
  /// many that the samples take less than half of them.
  std::size_t places() const;

 private:
  std::vector<RefineProgress> samples_;
};

/// Ends on multiples of a step of 1, 2 or 5 times a power of ten.
struct PlotAxis {
  double low = 0.0;
  double high = 1.0;
  double step = 0.5;

  /// 0 at the lower end, 1 at the upper one.
  double share(double value) const { return (value - low) / (high - low); }
  /// With as many digits as the step needs.
  std::string text(double value) const;
};

/// Spans all finite values with at most `max_steps` (at least 2) steps; 0 to 1 if there are none.
PlotAxis axis_over(const std::vector<double>& values, int max_steps);

}  // namespace facet_mapping
