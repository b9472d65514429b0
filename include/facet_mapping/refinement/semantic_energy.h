// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The single-view semantic energy and its gradient in the vertex positions (Romanoni et al. 2017,
// Sec. 3.2).
#pragma once

#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/semantic_gate.h"
#include "facet_mapping/refinement/surface_view.h"
#include "facet_mapping/refinement/vertex_field.h"

namespace facet_mapping {

/// A view with its segmentation at the size of the rendering.
struct SemanticView {
  View view;
  cv::Mat segmentation;  ///< CV_16UC1, kUnlabelled = says nothing; empty if there is none
};

struct SemanticEnergy {
  double sum = 0.0;        ///< sum_i sum_l sum_u chi sum_{w in W} (M2 - M3)^2 / |W|
  std::size_t pixels = 0;  ///< number of (i, l, u) with chi = 1
  VertexField field;       ///< of `sum`

  /// 0 where mesh and segmentation agree, 1 where they never do.
  double mean() const { return pixels > 0 ? sum / static_cast<double>(pixels) : 0.0; }
};

/// One gate per view, from the mesh as rendered now; empty gates for views without segmentation.
std::vector<SemanticGate> semantic_gates(const TriangleMesh& mesh,
                                         const std::vector<SemanticView>& views,
                                         const std::vector<SurfaceView>& surfaces,
                                         int window_px);

/// Sum and count alone, of `surfaces` under the given gates (which may be those of an earlier
/// shape: the gate moves with the border, and that motion is no force).
SemanticEnergy semantic_energy(const TriangleMesh& mesh,
                               const std::vector<SemanticView>& views,
                               const std::vector<SurfaceView>& surfaces,
                               const std::vector<SemanticGate>& gates);

/// The first variation of the energy in two parts, whose sum it is.
struct SemanticGradient {
  VertexField contours;  ///< from borders where the surface turns away and hides another
  VertexField seams;     ///< from borders where facets of two classes share an edge
};

/// The first variation of the energy under fixed gates. The paper moves points along their own
/// viewing ray, which moves nothing in that image; what changes the rendered masks is the motion of
/// the borders between rendered classes:
///   dE/dX_k = sum over border points of phi_k [e_a - e_b] DP_i(x)^T m,
/// per pixel of border, m the image normal from class a to class b, e_q the gated cost of showing
/// class q there. At an occluding contour the border belongs to the nearer surface alone. Left out:
/// the end of an open mesh, which is where the reconstruction ends and not where an object does.
/// The curvature lets a vertex move about one pixel where all votes agree.
SemanticGradient semantic_gradient(const TriangleMesh& mesh,
                                   const std::vector<SemanticView>& views,
                                   const std::vector<SurfaceView>& surfaces,
                                   const std::vector<SemanticGate>& gates);

/// Leaves only the part of the gradient along the vertex normals: it moves the shape but does not
/// slide class borders over the surface.
void keep_normal_part(const TriangleMesh& mesh, VertexField* field);

/// Leaves only the part across the vertex normals: it slides class borders over the surface but
/// does not move the shape.
void keep_tangential_part(const TriangleMesh& mesh, VertexField* field);

}  // namespace facet_mapping
