// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The viewing rays that the map's evidence consists of.
#pragma once

#include <cstdint>

#include "carving/paged_store.h"
#include <Eigen/Core>

#include "facet_mapping/carving/space_carver.h"

namespace facet_mapping::carving {

using RayId = std::uint32_t;   ///< ascends in the order of insertion
using SiteId = std::uint32_t;  ///< of a vertex of the triangulation

struct Ray {
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();  ///< point - sensor, metres
  float sigma = 0.0F;                                ///< along the ray, metres
  SiteId site = kNoId;                               ///< the vertex that stands for the point
  FrameId frame = kNoId;
  std::uint32_t epoch = 0;  ///< batch in which it was last put up for tracing
  Label label = kUnlabelled;
  bool fresh = true;    ///< no cell has this ray's evidence
  bool open = false;    ///< no surface at its end
  bool active = false;  ///< gives evidence: the first ray of its frame to its site
};

struct RayFrame {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the sensor, map frame, metres
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();     ///< the same in general position
  RayId first = 0;                                   ///< its rays are first .. first + count - 1
  std::uint32_t count = 0;
  std::uint32_t live = 0;  ///< rays not yet erased
};

struct RayStore {
  PagedStore<Ray> rays;
  PagedStore<RayFrame> frames;

  Eigen::Vector3d point(const Ray& ray) const {
    return frames[ray.frame].center + ray.offset.cast<double>();
  }
  /// Erases a ray, and its frame with the last of its rays.
  void erase(RayId id) {
    const FrameId frame = rays[id].frame;
    rays.erase(id);
    if (--frames[frame].live == 0) {
      frames.erase(frame);
    }
  }
};

}  // namespace facet_mapping::carving
