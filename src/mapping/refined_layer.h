// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A state of the map and what refinement made of it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "point_lookup.h"

#include "facet_mapping/geometry/facet_search.h"
#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// A facet with the matched instead of its own corners.
Triangle corners(const Triangle& t, const std::vector<std::uint32_t>& matched);

class RefinedLayer {
 public:
  /// `refined` has start_points on `map`; `in_part`: per facet of `map`, could it change?
  RefinedLayer(const TriangleMesh& map,
               TriangleMesh refined,
               const std::vector<std::uint8_t>& in_part);
  RefinedLayer(const RefinedLayer&) = delete;
  RefinedLayer& operator=(const RefinedLayer&) = delete;

  const TriangleMesh& refined() const { return refined_; }

  /// Vertex of this layer's map at each of the points, or PointLookup::kNone.
  std::vector<std::uint32_t> match(const std::vector<Eigen::Vector3d>& points) const;

  /// Is this the state of the map from which the layer was made? `matched`: match(map.vertices).
  bool is_made_from(const TriangleMesh& map, const std::vector<std::uint32_t>& matched) const;

  /// What became of a facet of the map.
  struct Piece {
    std::uint32_t first = 0;  ///< of its refined facets, in piece order
    std::uint32_t count = 0;
    bool may_change = false;
  };

  /// Null if the facet could not change or did not exist. Corners as matched.
  const Piece* piece(const Triangle& matched) const;

  /// Where a point on the map's facet has moved.
  Eigen::Vector3d moved(const Eigen::Vector3d& point, const Piece& piece) const;
  /// The refined facet at a point on the map's facet.
  NearestFacet refined_facet(const Eigen::Vector3d& point, const Piece& piece) const;

  std::size_t bytes() const;  ///< of memory held, about

 private:
  struct Hash {
    std::size_t operator()(const Triangle& t) const;
  };
  void add_pieces(const TriangleMesh& map, const std::vector<std::uint8_t>& in_part);

  void sort_facets(const std::vector<Piece*>& pieces, const std::vector<Piece*>& parents);

  std::vector<Eigen::Vector3d> map_points_;
  TriangleMesh refined_;
  PointLookup map_lookup_;
  PointLookup start_lookup_;
  FacetSearch start_surface_;
  std::unordered_map<Triangle, Piece, Hash> pieces_;  ///< corners as first_least() has them
  std::vector<std::uint32_t> facets_;                 ///< refined ones, in piece order
};

}  // namespace facet_mapping
