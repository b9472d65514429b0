// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refined_layer.h"

#include <algorithm>
#include <utility>

#include "hash_bits.h"
#include <tbb/parallel_for.h>

#include "facet_mapping/geometry/facet_centroid.h"

namespace facet_mapping {
namespace {

/// The same facet, begun at its least corner.
Triangle first_least(const Triangle& t) {
  const auto least = std::min_element(t.begin(), t.end()) - t.begin();
  return {t[least], t[(least + 1) % 3], t[(least + 2) % 3]};
}

Eigen::Vector3d at_weights(const std::vector<Eigen::Vector3d>& points,
                           const Triangle& t,
                           const Eigen::Vector3d& weights) {
  return weights[0] * points[t[0]] + weights[1] * points[t[1]] + weights[2] * points[t[2]];
}

bool has_moved(const TriangleMesh& mesh, const Triangle& t) {
  return std::any_of(t.begin(), t.end(), [&mesh](std::uint32_t v) {
    return mesh.vertices[v] != mesh.start_points[v];
  });
}

}  // namespace

Triangle corners(const Triangle& t, const std::vector<std::uint32_t>& matched) {
  return {matched[t[0]], matched[t[1]], matched[t[2]]};
}

std::size_t RefinedLayer::Hash::operator()(const Triangle& t) const {
  std::uint64_t hash = 0;
  for (const std::uint32_t v : t) {
    hash = add_to_hash(hash, v);
  }
  return hash;
}

RefinedLayer::RefinedLayer(const TriangleMesh& map,
                           TriangleMesh refined,
                           const std::vector<std::uint8_t>& in_part)
    : map_points_(map.vertices),
      refined_(std::move(refined)),
      map_lookup_(map_points_, rounding_tolerance(map_points_)),
      start_lookup_(refined_.start_points, rounding_tolerance(map_points_)),
      start_surface_(refined_.start_points, refined_.triangles) {
  add_pieces(map, in_part);
}

void RefinedLayer::add_pieces(const TriangleMesh& map, const std::vector<std::uint8_t>& in_part) {
  const std::vector<std::uint32_t> matched = match(map.vertices);
  std::vector<Piece*> pieces;
  pieces_.reserve(map.triangles.size());
  for (std::size_t f = 0; f < map.triangles.size(); ++f) {
    pieces.push_back(&pieces_[first_least(corners(map.triangles[f], matched))]);
    pieces.back()->may_change |= in_part[f] != 0;
  }
  const FacetSearch search(map.vertices, map.triangles);
  std::vector<Piece*> parents(refined_.triangles.size());
  tbb::parallel_for(std::size_t{0}, parents.size(), [&](std::size_t f) {
    parents[f] =
        pieces[search.nearest(facet_centroid(refined_.start_points, refined_.triangles[f])).facet];
  });
  for (std::size_t f = 0; f < parents.size(); ++f) {
    // Facets may join a part of certain classes while it is refined.
    parents[f]->may_change |= has_moved(refined_, refined_.triangles[f]);
    ++parents[f]->count;
  }
  sort_facets(pieces, parents);
}

void RefinedLayer::sort_facets(const std::vector<Piece*>& pieces,
                               const std::vector<Piece*>& parents) {
  std::uint32_t next = 0;
  for (Piece* piece : pieces) {
    piece->first = next;
    next += piece->count;
  }
  facets_.resize(next);
  std::unordered_map<const Piece*, std::uint32_t> filled;
  for (std::uint32_t f = 0; f < parents.size(); ++f) {
    facets_[parents[f]->first + filled[parents[f]]++] = f;
  }
}

std::vector<std::uint32_t> RefinedLayer::match(const std::vector<Eigen::Vector3d>& points) const {
  std::vector<std::uint32_t> matched(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
    matched[k] = map_lookup_.find(points[k]);
  });
  return matched;
}

bool RefinedLayer::is_made_from(const TriangleMesh& map,
                                const std::vector<std::uint32_t>& matched) const {
  return map.triangles.size() == pieces_.size() &&
         std::all_of(map.triangles.begin(), map.triangles.end(), [&](const Triangle& t) {
           return pieces_.count(first_least(corners(t, matched))) > 0;
         });
}

const RefinedLayer::Piece* RefinedLayer::piece(const Triangle& matched) const {
  const auto found = pieces_.find(first_least(matched));
  return found != pieces_.end() && found->second.may_change ? &found->second : nullptr;
}

Eigen::Vector3d RefinedLayer::moved(const Eigen::Vector3d& point, const Piece& piece) const {
  const std::uint32_t vertex = start_lookup_.find(point);
  if (vertex != PointLookup::kNone) {
    return refined_.vertices[vertex];
  }
  const NearestFacet nearest = refined_facet(point, piece);
  const Triangle& t = refined_.triangles[nearest.facet];
  return point + at_weights(refined_.vertices, t, nearest.weights) - nearest.point;
}

NearestFacet RefinedLayer::refined_facet(const Eigen::Vector3d& point, const Piece& piece) const {
  constexpr double kRounding = 1e-9;
  constexpr double kMostOffPlane = 1e-3;  // in lengths of the facet
  const std::vector<Eigen::Vector3d>& x = refined_.start_points;
  for (std::uint32_t k = 0; k < piece.count; ++k) {  // mostly it is one of these few
    const std::uint32_t facet = facets_[piece.first + k];
    const Triangle& t = refined_.triangles[facet];
    const Eigen::Vector3d weights = barycentric_weights(x[t[0]], x[t[1]], x[t[2]], point);
    const Eigen::Vector3d there = at_weights(x, t, weights);
    const double off_plane = (there - point).squaredNorm();
    const double size = kMostOffPlane * kMostOffPlane * (x[t[1]] - x[t[0]]).squaredNorm();
    if (weights.minCoeff() >= -kRounding && off_plane <= size) {
      return {facet, there, weights};
    }
  }
  return start_surface_.nearest(point);
}

std::size_t RefinedLayer::bytes() const {
  constexpr std::size_t kNode = sizeof(Triangle) + sizeof(Piece) + 2 * sizeof(void*);
  constexpr std::size_t kTreeNode = 64;
  return bytes_of(map_points_) + bytes_of(refined_) + bytes_of(facets_) + map_lookup_.bytes() +
         start_lookup_.bytes() + pieces_.size() * kNode + pieces_.bucket_count() * sizeof(void*) +
         refined_.triangles.size() * kTreeNode;
}

}  // namespace facet_mapping
