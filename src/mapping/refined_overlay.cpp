// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/refined_overlay.h"

#include <stdexcept>
#include <utility>

#include "refined_layer.h"
#include <tbb/parallel_for.h>

#include "facet_mapping/refinement/subdivision.h"

namespace facet_mapping {
namespace {

using Layers = std::vector<const RefinedLayer*>;  // the newest first

/// Which layer gives each facet its shape, and in how many pieces.
struct Owners {
  std::vector<const RefinedLayer*> layer;  ///< null: none
  std::vector<double> pieces;              ///< 0 where no layer has a say
};

Owners find_owners(const TriangleMesh& map, const Layers& layers) {
  Owners owners{std::vector<const RefinedLayer*>(map.triangles.size(), nullptr),
                std::vector<double>(map.triangles.size(), 0.0)};
  for (const RefinedLayer* layer : layers) {
    const std::vector<std::uint32_t> matched = layer->match(map.vertices);
    for (std::size_t f = 0; f < map.triangles.size(); ++f) {
      const auto pieces = owners.layer[f] != nullptr
                              ? std::nullopt
                              : layer->pieces(corners(map.triangles[f], matched));
      if (pieces) {
        owners.layer[f] = layer;
        owners.pieces[f] = *pieces;
      }
    }
  }
  return owners;
}

/// Vertices move with the first layer that has a facet of theirs.
void move_vertices(const std::vector<const RefinedLayer*>& owner,
                   const Layers& layers,
                   TriangleMesh* mesh) {
  for (const RefinedLayer* layer : layers) {
    std::vector<std::uint8_t> is_owned(mesh->vertices.size(), 0);
    for (std::size_t f = 0; f < mesh->triangles.size(); ++f) {
      for (const std::uint32_t v : mesh->triangles[f]) {
        is_owned[v] |= owner[f] == layer ? 1 : 0;
      }
    }
    tbb::parallel_for(std::size_t{0}, mesh->vertices.size(), [&](std::size_t v) {
      if (is_owned[v] != 0 && mesh->vertices[v] == mesh->start_points[v]) {
        mesh->vertices[v] = layer->moved(mesh->start_points[v]);
      }
    });
  }
}

/// An attribute that only the refined mesh has begins as `absent`.
template <typename Value>
void make_room(const std::vector<Value>& refined,
               std::size_t facets,
               Value absent,
               std::vector<Value>* values) {
  if (values->empty() && !refined.empty()) {
    values->assign(facets, absent);
  }
}

template <typename Value>
void take(const std::vector<Value>& from, std::size_t k, Value* value) {
  if (!from.empty()) {
    *value = from[k];
  }
}

void take_attributes(const std::vector<const RefinedLayer*>& owner,
                     const Layers& layers,
                     TriangleMesh* mesh) {
  const std::size_t facets = mesh->triangles.size();
  for (const RefinedLayer* layer : layers) {
    make_room(layer->refined().labels, facets, kUnlabelled, &mesh->labels);
    make_room(layer->refined().confidence, facets, 0.0F, &mesh->confidence);
    make_room(layer->refined().views, facets, std::uint16_t{1}, &mesh->views);
  }
  tbb::parallel_for(std::size_t{0}, facets, [&](std::size_t f) {
    if (owner[f] == nullptr) {
      return;
    }
    const Triangle& t = mesh->triangles[f];
    const TriangleMesh& from = owner[f]->refined();
    const std::vector<Eigen::Vector3d>& x = mesh->start_points;
    const std::uint32_t k = owner[f]->refined_facet((x[t[0]] + x[t[1]] + x[t[2]]) / 3.0);
    take(from.labels, k, &mesh->labels[f]);
    take(from.confidence, k, &mesh->confidence[f]);
    take(from.views, k, &mesh->views[f]);
  });
}

TriangleMesh lay_over(const TriangleMesh& map, const Layers& layers) {
  constexpr double kMostPieces = 1.5;  // midway between one and the two of a bisection
  const RefinedLayer& newest = *layers.front();
  if (layers.size() == 1 && newest.is_made_from(map, newest.match(map.vertices))) {
    return newest.refined();
  }
  const Owners owners = find_owners(map, layers);
  std::vector<std::uint32_t> parents;
  TriangleMesh merged = subdivide(map, owners.pieces, kMostPieces, &parents);
  merged.start_points = merged.vertices;
  std::vector<const RefinedLayer*> owner(parents.size());
  for (std::size_t f = 0; f < owner.size(); ++f) {
    owner[f] = owners.layer[parents[f]];
  }
  move_vertices(owner, layers, &merged);
  take_attributes(owner, layers, &merged);
  return merged;
}

}  // namespace

RefinedOverlay::RefinedOverlay() = default;
RefinedOverlay::~RefinedOverlay() = default;

void RefinedOverlay::add(const TriangleMesh& map, TriangleMesh refined, const MeshPart& part) {
  validate(map);
  validate(refined);
  if (refined.start_points.empty() || map.empty()) {
    throw std::invalid_argument(
        "refined overlay: the refined mesh must say where its vertices lay on the map "
        "(start_points)");
  }
  std::vector<std::uint8_t> in_part = facets_of_part(map, part);
  auto layer = std::make_unique<RefinedLayer>(map, std::move(refined), in_part);
  if (layer_ && !part.is_everything()) {
    const Layers both{layer.get(), layer_.get()};
    const Owners owners = find_owners(map, both);
    for (std::size_t f = 0; f < in_part.size(); ++f) {
      in_part[f] = owners.layer[f] != nullptr ? 1 : 0;
    }
    layer = std::make_unique<RefinedLayer>(map, lay_over(map, both), in_part);
  }
  layer_ = std::move(layer);
}

TriangleMesh RefinedOverlay::merge(const TriangleMesh& map) const {
  return layer_ && !map.empty() ? lay_over(map, {layer_.get()}) : map;
}

void RefinedOverlay::clear() {
  layer_.reset();
}

std::size_t RefinedOverlay::bytes() const {
  return layer_ ? layer_->bytes() : 0;
}

}  // namespace facet_mapping
