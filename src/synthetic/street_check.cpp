// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "street_check.h"

#include <sstream>
#include <stdexcept>

#include "trajectory.h"

namespace facet_mapping {
namespace {

class Problems {
 public:
  void require(const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      text_ << "; " << name << " is " << value << ", give " << low << " to " << high;
    }
  }
  void add(const std::string& problem) { text_ << "; " << problem; }
  void report() const {
    if (!text_.str().empty()) {
      throw std::invalid_argument("synthetic street: " + text_.str().substr(2));
    }
  }

 private:
  std::ostringstream text_;
};

}  // namespace

void check(const StreetConfig& config) {
  Problems problems;
  problems.require("length_m", config.length_m, 20.0, 5000.0);
  problems.require("bend_rad", config.bend_rad, -0.5, 0.5);
  problems.require("bend_period_m", config.bend_period_m, 100.0, 1e6);
  problems.require("crown_m", config.crown_m, 0.0, 0.5);
  problems.require("kerb_height_m", config.kerb_height_m, 0.01, 0.5);
  problems.require("car_density", config.car_density, 0.0, 1.0);
  problems.require("tree_spacing_m", config.tree_spacing_m, 4.0, 1e6);
  problems.require("gap_share", config.gap_share, 0.0, 1.0);
  problems.require("camera_height_m", config.camera_height_m, 0.3, 4.0);
  problems.require("frame_spacing_m", config.frame_spacing_m, 0.01, 100.0);
  problems.require("frame_rate_hz", config.frame_rate_hz, 0.01, 1000.0);
  problems.require("pose_jitter", config.pose_jitter, 0.0, 10.0);
  problems.require("frames", config.frames, 0, 1e6);
  problems.report();
  if (config.frames > fitting_frames(config)) {
    std::ostringstream text;
    text << config.frames << " frames every " << config.frame_spacing_m << " m do not fit "
         << config.length_m << " m of street; give at most " << fitting_frames(config)
         << " frames or a length_m of at least "
         << (config.frames - 1) * config.frame_spacing_m + kStreetEndMargin;
    problems.add(text.str());
  }
  problems.report();
}

}  // namespace facet_mapping
