// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/semantic_energy.h"

#include "border_forces.h"
#include "ordered_reduce.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {

std::vector<SemanticGate> semantic_gates(const TriangleMesh& mesh,
                                         const std::vector<SemanticView>& views,
                                         const std::vector<SurfaceView>& surfaces,
                                         int window_px) {
  std::vector<SemanticGate> gates(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    if (!views[i].segmentation.empty()) {
      gates[i] = SemanticGate(label_image(surfaces[i].image, mesh), window_px);
    }
  });
  return gates;
}

SemanticEnergy semantic_energy(const TriangleMesh& mesh,
                               const std::vector<SemanticView>& views,
                               const std::vector<SurfaceView>& surfaces,
                               const std::vector<SemanticGate>& gates) {
  SemanticEnergy total;
  const auto compare_view = [&](std::size_t i) {
    return views[i].segmentation.empty()
               ? 0.0
               : gates[i].energy(label_image(surfaces[i].image, mesh), views[i].segmentation);
  };
  ordered_reduce(views.size(), compare_view, [&](std::size_t i, double energy) {
    total.sum += energy;
    total.pixels += gates[i].size();
  });
  return total;
}

SemanticGradient semantic_gradient(const TriangleMesh& mesh,
                                   const std::vector<SemanticView>& views,
                                   const std::vector<SurfaceView>& surfaces,
                                   const std::vector<SemanticGate>& gates) {
  SemanticGradient result{VertexField(mesh.vertices.size()), VertexField(mesh.vertices.size())};
  if (mesh.labels.empty()) {
    return result;
  }
  const std::vector<FacetNeighbours> neighbours = facet_neighbours(mesh);
  const auto trace_view = [&](std::size_t i) {
    return views[i].segmentation.empty()
               ? std::vector<VertexForce>{}
               : border_forces(mesh, neighbours, views[i], surfaces[i].image, gates[i]);
  };
  ordered_reduce(
      views.size(), trace_view, [&](std::size_t, const std::vector<VertexForce>& forces) {
        for (const VertexForce& f : forces) {
          VertexField& field = f.occluding ? result.contours : result.seams;
          field.add(f.vertex, f.gradient, f.curvature);
        }
      });
  return result;
}

void keep_normal_part(const TriangleMesh& mesh, VertexField* field) {
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    field->gradient[k] = normals[k].dot(field->gradient[k]) * normals[k];
  }
}

void keep_tangential_part(const TriangleMesh& mesh, VertexField* field) {
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    field->gradient[k] -= normals[k].dot(field->gradient[k]) * normals[k];
  }
}

}  // namespace facet_mapping
