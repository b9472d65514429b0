// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What refinement made of the map, laid over later states of the map.
#pragma once

#include <cstddef>
#include <memory>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/geometry/mesh_part.h"

namespace facet_mapping {

class RefinedLayer;

/// The mapper's mesh changes only where new evidence comes in. Facets that are still there as they
/// were when they were refined get their refined shape, fineness and class back; the others are as
/// the mapper sees them, and follow where a corner of theirs was refined.
class RefinedOverlay {
 public:
  RefinedOverlay();
  ~RefinedOverlay();
  RefinedOverlay(const RefinedOverlay&) = delete;
  RefinedOverlay& operator=(const RefinedOverlay&) = delete;

  /// Remembers `refined`, which was made from `map`, or from an earlier merge() over it: its
  /// start_points lie on `map`. With a part, what was remembered outside it stays. Throws
  /// std::invalid_argument if a mesh is invalid or `refined` has no start_points.
  void add(const TriangleMesh& map, TriangleMesh refined, const MeshPart& part);

  /// The present state of the map with what was refined in its place; start_points lie on `map`. A
  /// map that is still the refined one gives exactly the refined mesh. Closed 2-manifolds stay so.
  TriangleMesh merge(const TriangleMesh& map) const;

  bool empty() const { return !layer_; }
  void clear();
  std::size_t bytes() const;  ///< of memory held, about

 private:
  std::unique_ptr<RefinedLayer> layer_;
};

}  // namespace facet_mapping
