// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/chunk_geometry.h"

#include <algorithm>
#include <cmath>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {
namespace {

constexpr float kFarthestVertex = 1.0e6F;  // metres; beyond lies no map, and the view would vanish

class GeometryBuilder {
 public:
  GeometryBuilder(const LabeledMeshChunk& chunk, const ClassSlots& slots)
      : chunk_(chunk),
        slots_(slots),
        is_taken_(chunk.vertices.size(), false),
        ring_(chunk.vertices.size(), 0) {
    const std::size_t facets = chunk.triangles.size() / 3;
    has_labels_ = fits(chunk.labels.size(), facets);
    geometry_.has_confidence = fits(chunk.confidence.size(), facets);
    geometry_.has_views = fits(chunk.views.size(), facets);
    chunk_code_ = static_cast<std::uint8_t>((static_cast<std::uint32_t>(chunk.key[0]) * 5U +
                                             static_cast<std::uint32_t>(chunk.key[1]) * 3U +
                                             static_cast<std::uint32_t>(chunk.key[2]) * 7U) %
                                            12U);
  }

  ChunkGeometry build() {
    for (const geometry_msgs::Point32& v : chunk_.vertices) {
      FacetVertex vertex;
      if (is_usable(v)) {
        vertex.position = {v.x, v.y, v.z};
      }
      source_.push_back(static_cast<std::uint32_t>(geometry_.vertices.size()));
      geometry_.vertices.push_back(vertex);
    }
    geometry_.indices.reserve(chunk_.triangles.size());
    for (std::size_t facet = 0; facet < chunk_.triangles.size() / 3; ++facet) {
      add(facet);
    }
    geometry_.bad_attributes |= chunk_.triangles.size() % 3 != 0;
    for (const std::uint32_t source : source_) {
      geometry_.on_border.push_back(ring_[source] != 0);
    }
    return std::move(geometry_);
  }

 private:
  static bool is_usable(const geometry_msgs::Point32& v) {
    return std::abs(v.x) < kFarthestVertex && std::abs(v.y) < kFarthestVertex &&
           std::abs(v.z) < kFarthestVertex;  // false for NaN
  }

  bool fits(std::size_t values, std::size_t facets) {
    geometry_.bad_attributes |= values != 0 && values != facets;
    return values == facets;
  }

  bool is_drawable(const Triangle& corners) const {
    return std::all_of(corners.begin(), corners.end(), [this](std::uint32_t k) {
      return k < chunk_.vertices.size() && is_usable(chunk_.vertices[k]);
    });
  }

  Eigen::Vector3f point(std::uint32_t vertex) const {
    const geometry_msgs::Point32& v = chunk_.vertices[vertex];
    return {v.x, v.y, v.z};
  }

  /// Turns the corners so that the last is no other facet's last one; a copy of it if need be.
  Triangle with_own_last(Triangle corners) {
    for (int turn = 0; turn < 3; ++turn) {
      if (!is_taken_[corners[2]]) {
        is_taken_[corners[2]] = true;
        return corners;
      }
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    FacetVertex copy;
    copy.position = geometry_.vertices[corners[2]].position;
    geometry_.vertices.push_back(copy);
    source_.push_back(corners[2]);
    corners[2] = static_cast<std::uint32_t>(geometry_.vertices.size() - 1);
    return corners;
  }

  std::array<std::uint8_t, 4> attributes(std::size_t facet) const {
    const Label label = has_labels_ ? chunk_.labels[facet] : kUnlabelled;
    const std::uint8_t confidence = geometry_.has_confidence ? chunk_.confidence[facet] : 255;
    const std::uint16_t views = geometry_.has_views ? chunk_.views[facet] : 1;
    return {slots_.at(label),
            confidence,
            static_cast<std::uint8_t>(std::min<std::uint16_t>(views, 255)),
            chunk_code_};
  }

  void add(std::size_t facet) {
    const Triangle given{chunk_.triangles[3 * facet],
                         chunk_.triangles[3 * facet + 1],
                         chunk_.triangles[3 * facet + 2]};
    if (!is_drawable(given)) {
      ++geometry_.bad_facets;
      return;
    }
    const Eigen::Vector3f a = point(given[0]);
    const Eigen::Vector3f cross = (point(given[1]) - a).cross(point(given[2]) - a);
    for (const std::uint32_t corner : given) {
      geometry_.box.extend(point(corner));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      ring_[given[k]] ^= (given[(k + 1) % 3] + 1) ^ (given[(k + 2) % 3] + 1);
    }
    const Triangle corners = with_own_last(given);
    FacetVertex& last = geometry_.vertices[corners[2]];
    last.facet = attributes(facet);
    geometry_.area_by_slot_m2[last.facet[0]] += 0.5 * static_cast<double>(cross.norm());
    const Eigen::Vector3f scaled = 127.0F * cross.normalized();
    for (int k = 0; k < 3; ++k) {
      last.normal[static_cast<std::size_t>(k)] =
          std::isfinite(scaled[k]) ? static_cast<std::int8_t>(std::lround(scaled[k])) : 0;
    }
    geometry_.indices.insert(geometry_.indices.end(), corners.begin(), corners.end());
  }

  const LabeledMeshChunk& chunk_;
  const ClassSlots& slots_;
  std::vector<bool> is_taken_;
  // By given vertex: exclusive or of its neighbours in all its facets. Within the surface each
  // neighbour comes twice and leaves nothing.
  std::vector<std::uint32_t> ring_;
  std::vector<std::uint32_t> source_;  // by vertex: the given one
  bool has_labels_ = false;
  std::uint8_t chunk_code_ = 0;
  ChunkGeometry geometry_;
};

}  // namespace

ChunkGeometry make_chunk_geometry(const LabeledMeshChunk& chunk, const ClassSlots& slots) {
  return GeometryBuilder(chunk, slots).build();
}

}  // namespace facet_mapping
