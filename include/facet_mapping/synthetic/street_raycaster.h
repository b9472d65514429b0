// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rays against the street's exact mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {

struct RayHit {
  std::int32_t facet = -1;  ///< of Street::mesh
  double distance = 0.0;    ///< in lengths of the direction
};

class StreetRaycaster {
 public:
  /// Builds a tree of boxes over all facets. Keeps a reference to the street.
  explicit StreetRaycaster(const Street& street);
  ~StreetRaycaster();
  StreetRaycaster(const StreetRaycaster&) = delete;
  StreetRaycaster& operator=(const StreetRaycaster&) = delete;

  /// The nearest facet, seen from either side, that the ray from `origin` meets. May be called from
  /// several threads.
  std::optional<RayHit> cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Distance of a point to the nearest facet, metres.
  double distance(const Eigen::Vector3d& point) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace facet_mapping
