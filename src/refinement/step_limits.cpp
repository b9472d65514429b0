// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "facet_mapping/refinement/step.h"

namespace facet_mapping {
namespace {

constexpr double kMinTurnCos = 0.2;

bool turns_over(const TriangleMesh& mesh, const VectorField& step, std::size_t facet) {
  const Eigen::Vector3d before = facet_cross(mesh, facet);
  const Triangle& t = mesh.triangles[facet];
  const Eigen::Vector3d a = mesh.vertices[t[0]] + step[t[0]];
  const Eigen::Vector3d b = mesh.vertices[t[1]] + step[t[1]];
  const Eigen::Vector3d c = mesh.vertices[t[2]] + step[t[2]];
  const Eigen::Vector3d after = (b - a).cross(c - a);
  const double before_norm = before.norm();
  return before_norm > 0.0 && !(before.dot(after) > kMinTurnCos * before_norm * after.norm());
}

std::vector<std::uint8_t> find_turning(const TriangleMesh& mesh, const VectorField& step) {
  std::vector<std::uint8_t> turning(mesh.triangles.size(), 0);
  tbb::parallel_for(std::size_t{0}, turning.size(), [&](std::size_t f) {
    turning[f] = turns_over(mesh, step, f) ? 1 : 0;
  });
  return turning;
}

}  // namespace

void limit_step(const TriangleMesh& mesh,
                const Adjacency& neighbours,
                double fraction,
                VectorField* step) {
  tbb::parallel_for(std::size_t{0}, step->size(), [&](std::size_t k) {
    double edges = 0.0;
    for (const std::uint32_t* l = neighbours.begin(k); l != neighbours.end(k); ++l) {
      edges += (mesh.vertices[*l] - mesh.vertices[k]).norm();
    }
    const double limit =
        edges > 0.0 ? fraction * edges / static_cast<double>(neighbours.size(k)) : 0.0;
    const double length = (*step)[k].norm();
    if (length > limit) {
      (*step)[k] *= limit / length;
    }
  });
}

std::size_t prevent_flips(const TriangleMesh& mesh, VectorField* step) {
  constexpr int kHalvings = 6;
  std::vector<std::uint8_t> held(step->size(), 0);
  // Every round after the halvings stops further vertices for good, so the loop ends.
  for (int round = 0;; ++round) {
    const std::vector<std::uint8_t> turning = find_turning(mesh, *step);
    std::vector<std::uint8_t> shorten(step->size(), 0);
    for (std::size_t f = 0; f < turning.size(); ++f) {
      for (const std::uint32_t v : mesh.triangles[f]) {
        shorten[v] |= turning[f];
      }
    }
    bool any = false;
    for (std::size_t k = 0; k < shorten.size(); ++k) {
      if (shorten[k] != 0 && !(*step)[k].isZero(0.0)) {
        (*step)[k] *= round < kHalvings ? 0.5 : 0.0;
        held[k] = 1;
        any = true;
      }
    }
    if (!any) {
      break;
    }
  }
  std::size_t count = 0;
  for (const std::uint8_t h : held) {
    count += h;
  }
  return count;
}

}  // namespace facet_mapping
