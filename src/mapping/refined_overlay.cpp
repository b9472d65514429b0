// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/refined_overlay.h"

#include <stdexcept>
#include <utility>

#include "refined_layer.h"
#include <tbb/parallel_for.h>

#include "facet_mapping/geometry/facet_centroid.h"
#include "facet_mapping/refinement/subdivision.h"

namespace facet_mapping {
namespace {

using Layers = std::vector<const RefinedLayer*>;  // the newest first

/// Who gives a facet its shape.
struct Owner {
  const RefinedLayer* layer = nullptr;  ///< null: the map itself
  const RefinedLayer::Piece* piece = nullptr;
};

/// Gives the facets that have no owner yet to the layer.
void add_owner(const TriangleMesh& map,
               const RefinedLayer& layer,
               const std::vector<std::uint32_t>& matched,
               std::vector<Owner>* owners) {
  tbb::parallel_for(std::size_t{0}, owners->size(), [&](std::size_t f) {
    Owner& owner = (*owners)[f];
    if (owner.layer == nullptr) {
      const auto* piece = layer.piece(corners(map.triangles[f], matched));
      owner = piece != nullptr ? Owner{&layer, piece} : Owner{};
    }
  });
}

/// As fine as refinement left it. `owners`, one per facet, are carried to the new facets.
TriangleMesh split_as_refined(const TriangleMesh& map, std::vector<Owner>* owners) {
  constexpr double kMostPieces = 1.9;  // two are worth a bisection, three not a second one
  std::vector<double> pieces(owners->size(), 0.0);
  for (std::size_t f = 0; f < pieces.size(); ++f) {
    pieces[f] = (*owners)[f].piece != nullptr ? (*owners)[f].piece->count : 0.0;
  }
  std::vector<std::uint32_t> parents;
  TriangleMesh mesh = subdivide(map, pieces, kMostPieces, &parents);
  mesh.start_points = mesh.vertices;
  std::vector<Owner> carried(parents.size());
  for (std::size_t f = 0; f < carried.size(); ++f) {
    carried[f] = (*owners)[parents[f]];
  }
  *owners = std::move(carried);
  return mesh;
}

/// Vertices move with the first layer that has a facet of theirs.
void move_vertices(const std::vector<Owner>& owners, const Layers& layers, TriangleMesh* mesh) {
  for (const RefinedLayer* layer : layers) {
    std::vector<const RefinedLayer::Piece*> pieces(mesh->vertices.size(), nullptr);
    for (std::size_t f = 0; f < mesh->triangles.size(); ++f) {
      for (const std::uint32_t v : mesh->triangles[f]) {
        pieces[v] = owners[f].layer == layer ? owners[f].piece : pieces[v];
      }
    }
    tbb::parallel_for(std::size_t{0}, mesh->vertices.size(), [&](std::size_t v) {
      if (pieces[v] != nullptr && mesh->vertices[v] == mesh->start_points[v]) {
        mesh->vertices[v] = layer->moved(mesh->start_points[v], *pieces[v]);
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

void take_attributes(const std::vector<Owner>& owners, const Layers& layers, TriangleMesh* mesh) {
  const std::size_t facets = mesh->triangles.size();
  for (const RefinedLayer* layer : layers) {
    make_room(layer->refined().labels, facets, kUnlabelled, &mesh->labels);
    make_room(layer->refined().confidence, facets, 0.0F, &mesh->confidence);
    make_room(layer->refined().views, facets, std::uint16_t{1}, &mesh->views);
  }
  tbb::parallel_for(std::size_t{0}, facets, [&](std::size_t f) {
    const auto [layer, piece] = owners[f];
    if (layer == nullptr) {
      return;
    }
    const Triangle& t = mesh->triangles[f];
    const TriangleMesh& from = layer->refined();
    const std::vector<Eigen::Vector3d>& x = mesh->start_points;
    const std::uint32_t k = layer->refined_facet((x[t[0]] + x[t[1]] + x[t[2]]) / 3.0, *piece).facet;
    take(from.labels, k, &mesh->labels[f]);
    take(from.confidence, k, &mesh->confidence[f]);
    take(from.views, k, &mesh->views[f]);
  });
}

TriangleMesh lay_over(const TriangleMesh& map, std::vector<Owner> owners, const Layers& layers) {
  TriangleMesh merged = split_as_refined(map, &owners);
  move_vertices(owners, layers, &merged);
  take_attributes(owners, layers, &merged);
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
    std::vector<Owner> owners(in_part.size());
    for (const RefinedLayer* one : both) {
      add_owner(map, *one, one->match(map.vertices), &owners);
    }
    for (std::size_t f = 0; f < in_part.size(); ++f) {
      in_part[f] = owners[f].layer != nullptr ? 1 : 0;
    }
    layer = std::make_unique<RefinedLayer>(map, lay_over(map, std::move(owners), both), in_part);
  }
  layer_ = std::move(layer);
}

TriangleMesh RefinedOverlay::merge(const TriangleMesh& map) const {
  if (!layer_ || map.empty()) {
    return map;
  }
  const std::vector<std::uint32_t> matched = layer_->match(map.vertices);
  if (layer_->is_made_from(map, matched)) {
    return layer_->refined();
  }
  std::vector<Owner> owners(map.triangles.size());
  add_owner(map, *layer_, matched, &owners);
  return lay_over(map, std::move(owners), {layer_.get()});
}

void RefinedOverlay::clear() {
  layer_.reset();
}

std::size_t RefinedOverlay::bytes() const {
  return layer_ ? layer_->bytes() : 0;
}

}  // namespace facet_mapping
