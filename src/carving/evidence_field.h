// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The Delaunay triangulation of the sites with every ray's evidence in the cells that it crosses.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "carving/ray_tracer.h"
#include "carving/rays.h"
#include "carving/triangulation.h"

namespace facet_mapping::carving {

struct NewVertex {
  SiteId site;
  Eigen::Vector3d point;
};

/// One change of what the map consists of. Rays that stay where they are need no mention.
struct FieldChange {
  std::vector<RayEnd> withdrawn;  ///< rays that go, or that end elsewhere now
  std::vector<SiteId> removed;    ///< vertices that go
  std::vector<NewVertex> added;
  std::vector<RayEnd> attached;  ///< rays that come, or that ended elsewhere before
  /// Outside this ball evidence counts no more: what changes there need not be traced again.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double exact_radius_m = std::numeric_limits<double>::infinity();
};

/// Invariant between calls: each cell's evidence is the sum over all rays that cross it. Only rays
/// that crossed a cell that is gone are traced again (Litvinov & Lhuillier 2014), and only new
/// cells take their evidence.
class EvidenceField {
 public:
  struct Config {
    double behind_distance_m;  ///< how far behind a point its label is evidence
    double cap_rays;           ///< evidence that a cell is scaled down to
  };

  EvidenceField(RayStore* rays, const Config& config) : store_(*rays), config_(config) {}

  void apply(const FieldChange& change);

  Triangulation& triangulation() { return triangulation_; }
  const Triangulation& triangulation() const { return triangulation_; }
  bool is_solid() const { return triangulation_.dimension() == 3; }
  /// Bytes of the triangulation and the evidence in it.
  std::size_t bytes() const;
  /// Of these, what new cells and vertices will take before more is asked of the system.
  std::size_t bytes_unused() const;

 private:
  void withdraw(const std::vector<RayEnd>& ends);
  void uncount(const std::vector<RayEnd>& ends);
  void remove_vertex(SiteId site, const FieldChange& change);
  bool is_exact(CellHandle cell, const FieldChange& change) const;
  void add_vertices(std::vector<NewVertex> vertices);
  VertexHandle add_vertex(const Point& point);
  void attach(const std::vector<RayEnd>& ends);
  void forget_evidence();
  void destroy(CellHandle cell);
  void trace();
  void trace_fresh(const std::vector<RayEnd>& ends);
  RayTracer tracer() const {
    return {triangulation_, store_, vertices_, config_.behind_distance_m};
  }
  void put(RayId id, const Hit& hit);
  void take(RayId id, const Hit& hit);
  bool weighs_anew(const CellInfo& cell, Weight free_after) const;

  RayStore& store_;
  Config config_;
  Triangulation triangulation_;
  VertexOfSite vertices_;
  std::vector<RayId> retrace_;  ///< rays put up for tracing in this batch
  std::uint32_t epoch_ = 0;
  CellHandle hint_;
};

}  // namespace facet_mapping::carving
