// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/classification.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace facet_mapping::carving {
namespace {

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

double cached_cosine(const Triangulation& triangulation, CellHandle cell, int facet) {
  constexpr double kOne = 127.0;
  std::int8_t& cosine = cell->info().cosine[facet];
  if (cosine == CellInfo::kUnknown) {
    cosine =
        static_cast<std::int8_t>(std::lround(kOne * sphere_cosine(triangulation, cell, facet)));
  }
  return cosine / kOne;
}

/// Surface quality of Labatut et al. 2009: 1 - min(cos phi, cos psi), 0 for a well-shaped surface
/// facet.
double facet_cost(const Triangulation& triangulation, CellHandle cell, int facet) {
  const CellHandle other = cell->neighbor(facet);
  const double phi = cached_cosine(triangulation, cell, facet);
  const double psi = cached_cosine(triangulation, other, other->index(cell));
  return 1.0 - std::min(phi, psi);
}

double free_evidence(CellHandle cell, double neighbour_share) {
  double neighbours = 0.0;
  for (int k = 0; k < 4 && neighbour_share > 0.0; ++k) {
    neighbours += cell->neighbor(k)->info().free;
  }
  return cell->info().free + neighbour_share * neighbours / 4.0;
}

bool is_free_by_count(CellHandle cell, double neighbour_share, Weight threshold) {
  const double free = free_evidence(cell, neighbour_share);
  return free >= threshold && free > cell->info().labels.largest();
}

/// A minimum cut over a region of cells; what lies around it keeps its side.
class CellCut {
 public:
  CellCut(const Triangulation& triangulation,
          const CarvingConfig& config,
          const std::vector<CellHandle>& region)
      : triangulation_(triangulation), config_(config), region_(region) {
    std::uint32_t count = 0;
    for (const CellHandle cell : region_) {
      cell->info().order = count++;
    }
    graph_.create(count + 2, 2 * count + 1);
  }

  void solve() {
    for (std::size_t k = 0; k < region_.size() + 2; ++k) {
      graph_.addVtx();
    }
    // OpenCV refuses a graph without edges, which a region of one cell is: two cells of no account.
    graph_.addEdges(static_cast<int>(region_.size()), static_cast<int>(region_.size()) + 1, 0., 0.);
    for (const CellHandle cell : region_) {
      add_cell(cell);
    }
    graph_.maxFlow();
    for (const CellHandle cell : region_) {
      cell->info().is_free = graph_.inSourceSegment(static_cast<int>(cell->info().order));
    }
  }

 private:
  // Free space is the source's side. The bias calls matter what no ray has touched.
  void add_cell(CellHandle cell) {
    constexpr double kMatterBias = 1.0;
    const CellInfo& info = cell->info();
    double free = free_evidence(cell, config_.neighbour_share);
    double matter = info.labels.sum();
    // One scale for both, so that hundreds of rays of a good sensor are no tie with forty of
    // another.
    const double cap = config_.evidence_cap * kRayWeight;
    const double scale = cap / std::max({cap, free, matter});
    free *= scale;
    matter = matter * scale + kMatterBias;
    for (int k = 0; k < 4; ++k) {
      const CellInfo& other = cell->neighbor(k)->info();
      if (other.in_region && info.order > other.order) {
        continue;  // the neighbour adds the facet
      }
      const double cost =
          config_.surface_quality_weight * kRayWeight * facet_cost(triangulation_, cell, k);
      if (other.in_region) {
        graph_.addEdges(static_cast<int>(info.order), static_cast<int>(other.order), cost, cost);
      } else {
        (other.is_free ? free : matter) += cost;
      }
    }
    graph_.addTermWeights(static_cast<int>(info.order), free, matter);
  }

  const Triangulation& triangulation_;
  const CarvingConfig& config_;
  const std::vector<CellHandle>& region_;
  cv::detail::GCGraph<double> graph_;
};

/// The changed cells and what surrounds them. Infinite cells stay matter.
std::vector<CellHandle> changed_region(Triangulation* triangulation, int rings) {
  std::vector<CellHandle> region;
  for (const CellHandle cell : triangulation->finite_cell_handles()) {
    if (cell->info().is_changed) {
      cell->info().is_changed = false;
      cell->info().in_region = true;
      region.push_back(cell);
    }
  }
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = region.size();
    for (; begin < end; ++begin) {
      for (int k = 0; k < 4; ++k) {
        const CellHandle next = region[begin]->neighbor(k);
        if (!next->info().in_region && !triangulation->is_infinite(next)) {
          next->info().in_region = true;
          region.push_back(next);
        }
      }
    }
  }
  return region;
}

}  // namespace

void classify_cells(Triangulation* triangulation, const CarvingConfig& config) {
  constexpr int kRings = 3;  // farther than that a changed cell hardly ever turns another one
  const bool counts = config.extraction == Extraction::kCount;
  const std::vector<CellHandle> region = changed_region(triangulation, counts ? 1 : kRings);
  if (region.empty()) {
    return;
  }
  if (counts) {
    const auto threshold =
        static_cast<Weight>(std::lround(std::max(1.0, config.free_space_threshold * kRayWeight)));
    for (const CellHandle cell : region) {
      cell->info().is_free = is_free_by_count(cell, config.neighbour_share, threshold);
    }
  } else {
    CellCut(*triangulation, config, region).solve();
  }
  for (const CellHandle cell : region) {
    cell->info().in_region = false;
  }
}

}  // namespace facet_mapping::carving
