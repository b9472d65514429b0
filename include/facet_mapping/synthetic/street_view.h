// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the synthetic street with exact depth and exact labels.
#pragma once

#include <cstdint>
#include <memory>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/render/facet_renderer.h"
#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {

struct StreetViewConfig {
  int supersampling = 3;           ///< samples per pixel and axis; odd, so that centres are hit
  double view_distance_m = 220.0;  ///< parts farther away are sky, in every image
  double haze_m = 900.0;           ///< distance over which contrast falls to 1/e
  bool shadows = true;             ///< cast by the sun
};

/// What a real camera adds. Same seed, same noise.
struct SensorNoise {
  double gain = 1.0;        ///< of the exposure
  double sigma_grey = 0.0;  ///< standard deviation per pixel and channel, grey levels
  std::uint64_t seed = 0;
};

struct StreetImage {
  cv::Mat color;   ///< CV_8UC3, BGR
  cv::Mat depth;   ///< CV_32FC1: planar depth in metres at the pixel centre, 0 = sky
  cv::Mat labels;  ///< CV_8UC1: class at the pixel centre, 10 = sky
};

class StreetRenderer {
 public:
  /// Throws std::invalid_argument if the configuration is out of range. Keeps a reference to the
  /// street. Prepares the shadows, which takes a while for long streets.
  StreetRenderer(const Street& street, const StreetViewConfig& config);
  ~StreetRenderer();
  StreetRenderer(const StreetRenderer&) = delete;
  StreetRenderer& operator=(const StreetRenderer&) = delete;

  /// `view`: optical frame in the map. May be called from several threads. Throws
  /// std::invalid_argument if the view is invalid.
  StreetImage render(const View& view, const SensorNoise& noise) const;

  /// Facets (of Street::mesh) and depth alone, at the pixel centres.
  FacetImage render_facets(const View& view) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace facet_mapping
