// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/classification.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace facet_mapping::carving {
namespace {

bool is_free_by_count(const Triangulation& triangulation, CellHandle cell, Weight threshold) {
  const CellInfo& info = cell->info();
  return !triangulation.is_infinite(cell) && info.free >= threshold &&
         info.free > info.labels.largest();
}

/// Cosine of the angle at which the circumsphere of a cell meets the plane of one of its facets,
/// seen from the facet's side: large where the cell is flat and wide.
double sphere_cosine(const Triangulation& triangulation, CellHandle cell, int facet) {
  if (triangulation.is_infinite(cell)) {
    return 0.0;
  }
  const Point center = CGAL::circumcenter(cell->vertex(0)->point(),
                                          cell->vertex(1)->point(),
                                          cell->vertex(2)->point(),
                                          cell->vertex(3)->point());
  const Point& a = cell->vertex((facet + 1) & 3)->point();
  const Point& b = cell->vertex((facet + 2) & 3)->point();
  const Point& c = cell->vertex((facet + 3) & 3)->point();
  const Kernel::Vector_3 normal = CGAL::cross_product(b - a, c - a);
  const Kernel::Vector_3 radius = center - a;
  const double length = std::sqrt(normal.squared_length() * radius.squared_length());
  if (!(length > 0.0)) {
    return 1.0;
  }
  const double inner = normal * (cell->vertex(facet)->point() - a) > 0.0 ? 1.0 : -1.0;
  return std::clamp(inner * (normal * radius) / length, -1.0, 1.0);
}

/// Surface quality of Labatut et al. 2009: 1 - min(cos phi, cos psi), 0 for a well-shaped surface
/// facet.
double facet_cost(const Triangulation& triangulation, CellHandle cell, int facet) {
  const CellHandle other = cell->neighbor(facet);
  const double phi = sphere_cosine(triangulation, cell, facet);
  const double psi = sphere_cosine(triangulation, other, other->index(cell));
  return 1.0 - std::min(phi, psi);
}

class CellCut {
 public:
  CellCut(Triangulation* triangulation, const CarvingConfig& config)
      : triangulation_(*triangulation), config_(config) {
    for (const CellHandle cell : triangulation_.all_cell_handles()) {
      cell->info().order = count_++;
    }
    graph_.create(count_, 2 * count_);
  }

  void solve() {
    for (unsigned k = 0; k < count_; ++k) {
      graph_.addVtx();
    }
    for (const CellHandle cell : triangulation_.all_cell_handles()) {
      add_evidence(cell);
      add_facets(cell);
    }
    graph_.maxFlow();
    for (const CellHandle cell : triangulation_.all_cell_handles()) {
      CellInfo& info = cell->info();
      info.is_free =
          !triangulation_.is_infinite(cell) && graph_.inSourceSegment(static_cast<int>(info.order));
    }
  }

 private:
  // Free space is the source's side. The bias calls matter what no ray has touched.
  void add_evidence(CellHandle cell) {
    constexpr double kMatterBias = 1.0;
    const CellInfo& info = cell->info();
    const double cap = config_.evidence_cap * kRayWeight;
    const bool infinite = triangulation_.is_infinite(cell);
    const double free = infinite ? 0.0 : std::min<double>(info.free, cap);
    const double matter = infinite ? cap : std::min<double>(info.labels.sum(), cap);
    graph_.addTermWeights(static_cast<int>(info.order), free, matter + kMatterBias);
  }

  void add_facets(CellHandle cell) {
    for (int k = 0; k < 4; ++k) {
      const CellHandle other = cell->neighbor(k);
      if (cell->info().order < other->info().order) {
        const double cost =
            config_.surface_quality_weight * kRayWeight * facet_cost(triangulation_, cell, k);
        graph_.addEdges(static_cast<int>(cell->info().order),
                        static_cast<int>(other->info().order),
                        cost,
                        cost);
      }
    }
  }

  Triangulation& triangulation_;
  const CarvingConfig& config_;
  unsigned count_ = 0;
  cv::detail::GCGraph<double> graph_;
};

void classify_by_count(Triangulation* triangulation, const CarvingConfig& config) {
  const auto threshold =
      static_cast<Weight>(std::lround(std::max(1.0, config.free_space_threshold * kRayWeight)));
  std::uint32_t order = 0;
  for (const CellHandle cell : triangulation->all_cell_handles()) {
    cell->info().order = order++;
    cell->info().is_free = is_free_by_count(*triangulation, cell, threshold);
  }
}

}  // namespace

std::vector<CellHandle> classify_cells(Triangulation* triangulation, const CarvingConfig& config) {
  if (config.extraction == Extraction::kCount) {
    classify_by_count(triangulation, config);
  } else {
    CellCut(triangulation, config).solve();
  }
  std::vector<CellHandle> by_weight;
  for (const CellHandle cell : triangulation->finite_cell_handles()) {
    if (cell->info().is_free) {
      by_weight.push_back(cell);
    }
  }
  std::sort(by_weight.begin(), by_weight.end(), [](CellHandle a, CellHandle b) {
    return a->info().free != b->info().free ? a->info().free > b->info().free
                                            : a->info().order < b->info().order;
  });
  return by_weight;
}

}  // namespace facet_mapping::carving
