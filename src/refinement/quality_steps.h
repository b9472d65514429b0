// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The two kinds of steps of improve_quality and what both keep account of.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "facet_shape.h"
#include "mesh_editor.h"

#include "facet_mapping/refinement/mesh_quality.h"

namespace facet_mapping {

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;  ///< ascending vertices

struct QualityState {
  QualityState(const TriangleMesh& mesh,
               const QualityOptions& options,
               const std::vector<std::uint8_t>& may_change);

  bool may_change(std::uint32_t facet) const {
    return changeable.empty() || changeable[facet] != 0;
  }

  FacetShape shape(const Triangle& t) const {
    return {editor.point(t[0]), editor.point(t[1]), editor.point(t[2])};
  }
  FacetShape shape(std::uint32_t facet) const { return shape(editor.mesh().triangles[facet]); }

  /// Two facets on the same side of every border that has to stay.
  bool same_region(std::uint32_t f, std::uint32_t g) const;

  const QualityOptions& options;
  const std::vector<std::uint8_t>& changeable;
  MeshEditor editor;
  std::vector<double> local_length;  ///< per vertex, of the start
  std::vector<double> drift;         ///< per facet: how far it may be from the start's surface
};

/// Collapses what is too short or a needle, the worst first; returns how many.
std::size_t collapse_edges(QualityState* state);

/// Flips until no flip helps; returns how many.
std::size_t flip_edges(QualityState* state);

}  // namespace facet_mapping
