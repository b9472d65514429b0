// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Which cells take evidence from a ray, and how much.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "carving/ray_walk.h"
#include "carving/rays.h"
#include "carving/triangulation.h"

namespace facet_mapping::carving {

/// A ray and the vertex at which it ends.
struct RayEnd {
  RayId ray;
  SiteId site;
};

/// One cell that a ray crosses.
struct Hit {
  /// Between sensor and point; behind the point; the infinite cell by which it leaves the hull.
  enum class Part : std::uint8_t { kFront, kBehind, kOutside };
  CellHandle cell;
  Weight weight;
  Part part;
};

struct RayHit {
  RayId ray;
  Hit hit;
};

using VertexOfSite = std::unordered_map<SiteId, VertexHandle>;

class RayTracer {
 public:
  RayTracer(const Triangulation& triangulation,
            const RayStore& rays,
            const VertexOfSite& vertices,
            double behind_distance_m)
      : triangulation_(triangulation),
        store_(rays),
        vertices_(vertices),
        behind_distance_m_(behind_distance_m) {}

  /// All cells of rays first[0 .. count - 1].
  std::vector<std::vector<Hit>> trace(const RayEnd* first, std::size_t count) const;

  /// The hits of rays in the new cells among `cells` (is_new), where `rays` holds, sorted, all rays
  /// that cross a new cell. Walks only there: into each run of new cells a ray comes through a
  /// facet of an old cell that lists it, or starts in it.
  std::vector<std::vector<RayHit>> trace_new_cells(const std::vector<CellHandle>& cells,
                                                   const std::vector<RayId>& rays) const;

 private:
  /// A ray's two parts, from its vertex to the sensor and away from it.
  struct Segments {
    RayId ray;
    float sigma;
    bool has_behind;
    VertexHandle vertex;
    Point source;
    std::array<Point, 2> targets;  ///< front, behind
  };
  class Weigher;
  class RayList;

  Segments segments(const RayEnd& end) const;
  void trace_part(const std::vector<Segments>& rays,
                  bool behind,
                  std::vector<std::vector<Hit>>* hits) const;
  void enter_cell(CellHandle cell, const RayList& rays, std::vector<RayHit>* hits) const;
  void enter_through(CellHandle old,
                     int facet,
                     const RayList& rays,
                     std::vector<RayHit>* hits) const;
  void start_ray(const Segments& ray, std::vector<RayHit>* hits) const;
  void follow(RayWalk walk, const Segments& ray, bool behind, std::vector<RayHit>* hits) const;

  const Triangulation& triangulation_;
  const RayStore& store_;
  const VertexOfSite& vertices_;
  double behind_distance_m_;
};

}  // namespace facet_mapping::carving
