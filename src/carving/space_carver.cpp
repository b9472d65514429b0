// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/carving/space_carver.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "carving/classification.h"
#include "carving/free_space.h"
#include "carving/point_index.h"
#include "carving/ray_walk.h"
#include "carving/steiner_grid.h"
#include "carving/surface.h"
#include "carving/triangulation.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {

using namespace carving;  // NOLINT(google-build-using-namespace): this file is that room's door

namespace {

/// Points this many standard deviations apart along the ray are one point.
constexpr double kSpacingInSigmas = 0.5;
constexpr double kJitterM = 1e-7;

Point to_point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// Moves a sensor position by far less than it is known, so that no ray runs exactly through an
/// edge or a vertex (as happens to a sensor at the origin of round coordinates).
Point general_position(const Eigen::Vector3d& center, std::size_t index, double amount_m) {
  const double angle = 2.399963 * static_cast<double>(index + 1);  // the golden angle
  const Eigen::Vector3d offset(std::cos(angle), std::sin(angle), std::cos(1.7 * angle));
  return to_point(center + amount_m * offset);
}

struct Ray {
  VertexHandle vertex;
  std::uint32_t center;
  float sigma;
  Label label;
};

/// One cell that a ray crosses; `front` tells free-space evidence from label evidence.
struct Hit {
  CellHandle cell;
  Weight weight;
  bool front;
};

void check_frame(const CarvingFrame& frame) {
  if (!frame.center.allFinite()) {
    throw std::invalid_argument("carving: a sensor position is not finite; check the poses");
  }
  for (std::size_t k = 0; k < frame.rays.size(); ++k) {
    if (!frame.rays[k].point.allFinite() || !(frame.rays[k].sigma >= 0.0F)) {
      throw std::invalid_argument("carving: point " + std::to_string(k) +
                                  " is not finite; drop such points before carving");
    }
  }
}

}  // namespace

void validate(const CarvingConfig& config) {
  const auto require = [](bool good, const char* name, const char* range) {
    if (!good) {
      throw std::invalid_argument(std::string("carving: ") + name + " must be " + range);
    }
  };
  require(config.free_space_threshold >= 0.0, "free_space_threshold", "zero or more");
  require(config.surface_quality_weight >= 0.0, "surface_quality_weight", "zero or more");
  require(config.evidence_cap > 0.0, "evidence_cap", "positive");
  require(config.behind_distance_m > 0.0, "behind_distance_m", "positive");
  require(config.steiner_spacing_m >= 0.0, "steiner_spacing_m", "zero (none) or positive");
  require(config.steiner_reach_m >= 0.0, "steiner_reach_m", "zero or more");
  require(config.steiner_clearance_m >= 0.0, "steiner_clearance_m", "zero or more");
  require(config.max_facet_edge_m > 0.0, "max_facet_edge_m", "positive");
  require(config.min_point_spacing_m > 0.0, "min_point_spacing_m", "positive");
}

class SpaceCarver::Impl {
 public:
  explicit Impl(const CarvingConfig& config)
      : config_(config),
        index_(config.min_point_spacing_m),
        steiner_(config.steiner_spacing_m, config.steiner_reach_m) {}

  void insert(const std::vector<CarvingFrame>& frames);
  CarvedSurface extract_surface();
  CarvingStats stats() const;
  std::vector<CellEvidence> evidence() const;

 private:
  void insert_frame(const CarvingFrame& frame);
  VertexHandle insert_vertex(const Eigen::Vector3d& point, bool steiner);
  VertexHandle insert_in_cells(const Point& point);
  void release_rays(CellHandle cell);
  void trace_all(const std::vector<std::uint32_t>& ids);
  std::vector<Hit> trace(const Ray& ray) const;
  void trace_front(const Ray& ray, std::vector<Hit>* hits) const;
  void trace_behind(const Ray& ray, std::vector<Hit>* hits) const;
  void apply(std::uint32_t id, const std::vector<Hit>& hits);

  CarvingConfig config_;
  Triangulation triangulation_;
  PointIndex index_;
  SteinerGrid steiner_;
  std::vector<VertexHandle> vertices_;  // by id
  std::vector<Point> centers_;
  std::vector<Ray> rays_;
  std::vector<std::uint32_t> ray_epoch_;  // epoch in which the ray was last put up for tracing
  std::vector<std::uint32_t> retrace_;    // rays to trace at the end of this batch
  std::size_t first_new_ray_ = 0;
  std::uint32_t epoch_ = 0;
  CellHandle hint_;
  GrowthStats growth_;
};

void SpaceCarver::Impl::insert(const std::vector<CarvingFrame>& frames) {
  for (const CarvingFrame& frame : frames) {
    check_frame(frame);
  }
  ++epoch_;
  if (retrace_.empty()) {
    first_new_ray_ = rays_.size();
  }
  for (const CarvingFrame& frame : frames) {
    insert_frame(frame);
  }
  if (triangulation_.dimension() == 3) {
    trace_all(retrace_);
    retrace_.clear();
  }
}

void SpaceCarver::Impl::insert_frame(const CarvingFrame& frame) {
  for (const Eigen::Vector3d& node : steiner_.take_around(frame.center)) {
    if (index_.find_near(node, config_.steiner_clearance_m) < 0) {
      insert_vertex(node, true);
    }
  }
  centers_.push_back(general_position(frame.center, centers_.size(), kJitterM));
  for (const CarvingFrame::Ray& ray : frame.rays) {
    const double spacing =
        std::max(config_.min_point_spacing_m, kSpacingInSigmas * static_cast<double>(ray.sigma));
    const std::int64_t near = index_.find_near(ray.point, spacing);
    const VertexHandle vertex = near >= 0 ? vertices_[near] : insert_vertex(ray.point, false);
    ++vertex->info().rays;
    if (ray.label != kUnlabelled) {
      vertex->info().labels.add(ray.label, kRayWeight);
    }
    retrace_.push_back(static_cast<std::uint32_t>(rays_.size()));
    rays_.push_back(
        {vertex, static_cast<std::uint32_t>(centers_.size() - 1), ray.sigma, ray.label});
    ray_epoch_.push_back(epoch_);
  }
}

VertexHandle SpaceCarver::Impl::insert_vertex(const Eigen::Vector3d& point, bool steiner) {
  const Point p = to_point(point);
  const VertexHandle vertex =
      triangulation_.dimension() == 3 ? insert_in_cells(p) : triangulation_.insert(p);
  if (vertices_.size() < triangulation_.number_of_vertices()) {  // not a point that was there
    vertex->info().id = static_cast<std::uint32_t>(vertices_.size());
    vertex->info().steiner = steiner;
    vertices_.push_back(vertex);
    if (!steiner) {
      index_.insert(point, vertex->info().id);
    }
  } else if (!steiner) {
    vertex->info().steiner = false;
  }
  return vertex;
}

VertexHandle SpaceCarver::Impl::insert_in_cells(const Point& point) {
  Triangulation::Locate_type type{};
  int i = 0;
  int j = 0;
  const CellHandle located = triangulation_.locate(point, type, i, j, hint_);
  if (type == Triangulation::VERTEX) {
    return located->vertex(i);
  }
  std::vector<CellHandle> conflicts;
  std::vector<Triangulation::Facet> border;
  triangulation_.find_conflicts(
      point, located, std::back_inserter(border), std::back_inserter(conflicts));
  for (const CellHandle cell : conflicts) {
    release_rays(cell);
  }
  const VertexHandle vertex = triangulation_.insert_in_hole(
      point, conflicts.begin(), conflicts.end(), border.front().first, border.front().second);
  std::vector<CellHandle> created;
  triangulation_.incident_cells(vertex, std::back_inserter(created));
  for (const CellHandle cell : created) {
    cell->info().epoch = epoch_;
  }
  hint_ = vertex->cell();
  return vertex;
}

void SpaceCarver::Impl::release_rays(CellHandle cell) {
  for (const std::uint32_t id : cell->info().rays) {
    if (ray_epoch_[id] != epoch_) {
      ray_epoch_[id] = epoch_;
      retrace_.push_back(id);
    }
  }
}

void SpaceCarver::Impl::trace_all(const std::vector<std::uint32_t>& ids) {
  constexpr std::size_t kBlock = 2048;  // bounds the memory of the hits waiting to be applied
  std::vector<std::vector<Hit>> hits(kBlock);
  for (std::size_t begin = 0; begin < ids.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, ids.size() - begin);
    tbb::parallel_for(
        std::size_t{0}, count, [&](std::size_t k) { hits[k] = trace(rays_[ids[begin + k]]); });
    for (std::size_t k = 0; k < count; ++k) {
      apply(ids[begin + k], hits[k]);
    }
  }
}

std::vector<Hit> SpaceCarver::Impl::trace(const Ray& ray) const {
  std::vector<Hit> hits;
  hits.reserve(128);
  trace_front(ray, &hits);
  if (ray.label != kUnlabelled) {
    trace_behind(ray, &hits);
  }
  return hits;
}

void SpaceCarver::Impl::trace_front(const Ray& ray, std::vector<Hit>* hits) const {
  const Point& source = ray.vertex->point();
  const Point& target = centers_[ray.center];
  const double length = std::sqrt(CGAL::squared_distance(source, target));
  Weight weight = 0;
  for (RayWalk walk(triangulation_, ray.vertex, target); !walk.done(); walk.advance()) {
    if (weight != kRayWeight) {
      const double reach = walk.at_target()
                               ? length
                               : distance_to_facet(walk.cell(), walk.exit_facet(), source, target);
      weight = soft_weight(reach, ray.sigma);
    }
    hits->push_back({walk.cell(), weight, true});
  }
}

void SpaceCarver::Impl::trace_behind(const Ray& ray, std::vector<Hit>* hits) const {
  const Point& source = ray.vertex->point();
  const Kernel::Vector_3 away = source - centers_[ray.center];
  const double length = std::sqrt(away.squared_length());
  if (length == 0.0) {
    return;
  }
  const Point target = source + away * (config_.behind_distance_m / length);
  for (RayWalk walk(triangulation_, ray.vertex, target); !walk.done(); walk.advance()) {
    hits->push_back({walk.cell(), kRayWeight, false});
  }
}

void SpaceCarver::Impl::apply(std::uint32_t id, const std::vector<Hit>& hits) {
  const bool is_new = id >= first_new_ray_;
  for (const Hit& hit : hits) {
    CellInfo& cell = hit.cell->info();
    if (!is_new && cell.epoch != epoch_) {
      continue;  // the cell is older than this batch and has this ray's evidence already
    }
    if (hit.front) {
      cell.free += hit.weight;
    } else {
      cell.labels.add(rays_[id].label, hit.weight);
    }
    cell.rays.push_back(id);
  }
}

CarvedSurface SpaceCarver::Impl::extract_surface() {
  growth_ = {};
  if (triangulation_.dimension() != 3) {
    return {};
  }
  growth_ = FreeSpaceGrowth(&triangulation_, classify_cells(&triangulation_, config_)).grow();
  return make_surface(triangulation_, config_.max_facet_edge_m);
}

CarvingStats SpaceCarver::Impl::stats() const {
  CarvingStats stats;
  stats.vertices = triangulation_.number_of_vertices();
  stats.cells = triangulation_.dimension() == 3 ? triangulation_.number_of_finite_cells() : 0;
  stats.rays = rays_.size();
  stats.free_cells = growth_.free_cells;
  stats.reached_cells = growth_.reached_cells;
  return stats;
}

std::vector<CellEvidence> SpaceCarver::Impl::evidence() const {
  std::vector<CellEvidence> cells;
  if (triangulation_.dimension() != 3) {
    return cells;
  }
  const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  for (const CellHandle cell : triangulation_.finite_cell_handles()) {
    CellEvidence evidence;
    for (int k = 0; k < 4; ++k) {
      const Point& p = cell->vertex(k)->point();
      evidence.vertices[k] = {p.x(), p.y(), p.z()};
    }
    std::sort(evidence.vertices.begin(), evidence.vertices.end(), less);
    evidence.free = cell->info().free;
    evidence.labels = cell->info().labels.weights();
    cells.push_back(std::move(evidence));
  }
  std::sort(cells.begin(), cells.end(), [&less](const CellEvidence& a, const CellEvidence& b) {
    return std::lexicographical_compare(
        a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), less);
  });
  return cells;
}

bool CellEvidence::operator==(const CellEvidence& other) const {
  return vertices == other.vertices && free == other.free && labels == other.labels;
}

SpaceCarver::SpaceCarver(const CarvingConfig& config) : impl_(std::make_unique<Impl>(config)) {
  validate(config);
}
SpaceCarver::~SpaceCarver() = default;
SpaceCarver::SpaceCarver(SpaceCarver&&) noexcept = default;
SpaceCarver& SpaceCarver::operator=(SpaceCarver&&) noexcept = default;

void SpaceCarver::insert(const std::vector<CarvingFrame>& frames) {
  impl_->insert(frames);
}
CarvedSurface SpaceCarver::extract_surface() {
  return impl_->extract_surface();
}
CarvingStats SpaceCarver::stats() const {
  return impl_->stats();
}

std::vector<CellEvidence> SpaceCarver::evidence() const {
  return impl_->evidence();
}

}  // namespace facet_mapping
