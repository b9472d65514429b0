// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_editor.h"

#include <algorithm>
#include <utility>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// The side of `t` that starts at `vertex`.
int side_of(const Triangle& t, std::uint32_t vertex) {
  return t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
}

bool contains(const Triangle& t, std::uint32_t vertex) {
  return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// Do the facets around `vertex` follow each other in one closed round?
bool is_closed_fan(const std::vector<Triangle>& triangles,
                   const std::vector<std::uint32_t>& star,
                   std::uint32_t vertex) {
  if (star.size() < 3) {
    return false;
  }
  const std::uint32_t first = triangles[star[0]][(side_of(triangles[star[0]], vertex) + 1) % 3];
  std::uint32_t at = first;
  for (std::size_t steps = 0; steps < star.size(); ++steps) {
    std::uint32_t next = kNone;
    for (const std::uint32_t f : star) {
      const Triangle& t = triangles[f];
      const int side = side_of(t, vertex);
      if (t[(side + 1) % 3] == at) {
        if (next != kNone) {
          return false;
        }
        next = t[(side + 2) % 3];
      }
    }
    if (next == kNone || (next == first) != (steps + 1 == star.size())) {
      return false;
    }
    at = next;
  }
  return true;
}

void erase(std::vector<std::uint32_t>* items, std::uint32_t item) {
  items->erase(std::find(items->begin(), items->end(), item));
}

}  // namespace

MeshEditor::MeshEditor(const TriangleMesh& mesh)
    : mesh_(mesh),
      alive_(mesh.triangles.size(), true),
      fixed_(mesh.vertices.size()),
      merged_(mesh.vertices.size(), false),
      star_(mesh.vertices.size()) {
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      if (star_[v].empty() || star_[v].back() != f) {
        star_[v].push_back(f);
      }
    }
  }
  for (std::uint32_t v = 0; v < star_.size(); ++v) {
    fixed_[v] = !is_closed_fan(mesh.triangles, star_[v], v);
  }
}

std::optional<EdgeSides> MeshEditor::sides(std::uint32_t from, std::uint32_t to) const {
  EdgeSides edge;
  edge.facets = {kNone, kNone};
  for (const std::uint32_t f : star_[from]) {
    const Triangle& t = mesh_.triangles[f];
    const int side = side_of(t, from);
    if (!contains(t, to)) {
      continue;
    }
    const int k = t[(side + 1) % 3] == to ? 0 : 1;
    if (edge.facets[k] != kNone) {
      return {};
    }
    edge.facets[k] = f;
    (k == 0 ? edge.left : edge.right) = t[(side + (k == 0 ? 2 : 1)) % 3];
  }
  const bool whole = edge.facets[0] != kNone && edge.facets[1] != kNone && edge.left != edge.right;
  return whole ? std::optional<EdgeSides>(edge) : std::nullopt;
}

std::uint32_t MeshEditor::next_around(std::uint32_t facet, std::uint32_t vertex) const {
  const Triangle& t = mesh_.triangles[facet];
  return t[(side_of(t, vertex) + 1) % 3];
}

bool MeshEditor::are_joined(std::uint32_t a, std::uint32_t b) const {
  return std::any_of(star_[a].begin(), star_[a].end(), [this, b](std::uint32_t f) {
    return contains(mesh_.triangles[f], b);
  });
}

bool MeshEditor::can_collapse(std::uint32_t from, std::uint32_t to, const EdgeSides& edge) const {
  if (fixed_[from]) {
    return false;
  }
  const auto is_end = [&](std::uint32_t v) { return v == edge.left || v == edge.right; };
  const auto closes = [&](std::uint32_t f) {
    return contains(mesh_.triangles[f], edge.left) && contains(mesh_.triangles[f], edge.right);
  };
  for (const std::uint32_t f : star_[from]) {
    const Triangle& t = mesh_.triangles[f];
    const std::uint32_t next = next_around(f, from);
    if (!contains(t, to) && !is_end(next) && are_joined(next, to)) {
      return false;  // the link condition: a neighbour in common beside the edge's two
    }
  }
  // A vertex of three facets leaves one facet behind: it must not be there already.
  return star_[from].size() > 3 || std::none_of(star_[to].begin(), star_[to].end(), closes);
}

void MeshEditor::collapse(std::uint32_t from, std::uint32_t to, const EdgeSides& edge) {
  for (const std::uint32_t f : edge.facets) {
    alive_[f] = false;
    erase(&star_[to], f);
    erase(&star_[f == edge.facets[0] ? edge.left : edge.right], f);
  }
  for (const std::uint32_t f : star_[from]) {
    if (alive_[f]) {
      Triangle& t = mesh_.triangles[f];
      t[side_of(t, from)] = to;
      star_[to].push_back(f);
    }
  }
  star_[from].clear();
  merged_[from] = true;
}

bool MeshEditor::can_flip(const EdgeSides& edge) const {
  return !are_joined(edge.left, edge.right);
}

void MeshEditor::flip(std::uint32_t from, std::uint32_t to, const EdgeSides& edge) {
  mesh_.triangles[edge.facets[0]] = {from, edge.right, edge.left};
  mesh_.triangles[edge.facets[1]] = {to, edge.left, edge.right};
  erase(&star_[from], edge.facets[1]);
  erase(&star_[to], edge.facets[0]);
  star_[edge.left].push_back(edge.facets[1]);
  star_[edge.right].push_back(edge.facets[0]);
}

TriangleMesh MeshEditor::take() && {
  std::vector<std::uint32_t> index(mesh_.vertices.size());
  std::vector<bool> stays(merged_.size());
  std::uint32_t count = 0;
  for (std::size_t v = 0; v < index.size(); ++v) {
    index[v] = count;
    stays[v] = !merged_[v];
    count += stays[v] ? 1 : 0;
  }
  mesh_.vertices = select_values(mesh_.vertices, stays);
  mesh_.start_points = select_values(mesh_.start_points, stays);
  mesh_.triangles = select_values(mesh_.triangles, alive_);
  for (Triangle& t : mesh_.triangles) {
    t = {index[t[0]], index[t[1]], index[t[2]]};
  }
  mesh_.labels = select_values(mesh_.labels, alive_);
  mesh_.confidence = select_values(mesh_.confidence, alive_);
  mesh_.views = select_values(mesh_.views, alive_);
  return std::move(mesh_);
}

}  // namespace facet_mapping
