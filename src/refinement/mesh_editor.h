// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh whose edges can be collapsed and flipped one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

/// The two facets (from, to, left) and (to, from, right) of an inner edge.
struct EdgeSides {
  std::array<std::uint32_t, 2> facets;
  std::uint32_t left = 0;   ///< third vertex of the first facet
  std::uint32_t right = 0;  ///< third vertex of the second one
};

class MeshEditor {
 public:
  explicit MeshEditor(const TriangleMesh& mesh);

  const TriangleMesh& mesh() const { return mesh_; }
  const Eigen::Vector3d& point(std::uint32_t vertex) const { return mesh_.vertices[vertex]; }
  bool is_alive(std::uint32_t facet) const { return alive_[facet]; }
  const std::vector<std::uint32_t>& facets_of(std::uint32_t vertex) const { return star_[vertex]; }

  /// Nothing if the edge is not there or has not exactly two facets that run through it opposite
  /// ways.
  std::optional<EdgeSides> sides(std::uint32_t from, std::uint32_t to) const;

  /// The vertex that follows `vertex` in the facet.
  std::uint32_t next_around(std::uint32_t facet, std::uint32_t vertex) const;

  bool are_joined(std::uint32_t a, std::uint32_t b) const;

  /// Can vertex `from` be merged into `to` with the surface topologically the same? Vertices on an
  /// open border or of several fans cannot.
  bool can_collapse(std::uint32_t from, std::uint32_t to, const EdgeSides& edge) const;
  void collapse(std::uint32_t from, std::uint32_t to, const EdgeSides& edge);

  /// Puts the edge (left, right) in the place of (from, to).
  bool can_flip(const EdgeSides& edge) const;
  void flip(std::uint32_t from, std::uint32_t to, const EdgeSides& edge);

  /// The mesh without what was collapsed, order and attributes kept.
  TriangleMesh take() &&;

 private:
  TriangleMesh mesh_;
  std::vector<bool> alive_;                       ///< per facet
  std::vector<bool> fixed_;                       ///< per vertex: its facets are not one closed fan
  std::vector<bool> merged_;                      ///< per vertex: collapsed into another
  std::vector<std::vector<std::uint32_t>> star_;  ///< facets per vertex
};

}  // namespace facet_mapping
