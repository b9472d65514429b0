// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/carving/space_carver.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "carving/classification.h"
#include "carving/evidence_field.h"
#include "carving/free_space.h"
#include "carving/rays.h"
#include "carving/sites.h"
#include "carving/steiner_grid.h"
#include "carving/surface.h"

#include "facet_mapping/geometry/segment.h"

namespace facet_mapping {

using namespace carving;  // NOLINT(google-build-using-namespace): this file is that room's door

namespace {

/// Moves a sensor position by far less than it is known, so that no ray runs exactly through an
/// edge or a vertex (as happens to a sensor at the origin of round coordinates).
Eigen::Vector3d general_position(const Eigen::Vector3d& center) {
  constexpr double kJitterM = 1e-7;
  const Eigen::Vector3d frequency(12.9898, 78.233, 37.719);
  const double angle = 43.758 * std::sin(center.dot(frequency)) + center.sum();
  return center +
         kJitterM * Eigen::Vector3d(std::cos(angle), std::sin(angle), std::cos(1.7 * angle));
}

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
  require(config.neighbour_share >= 0.0 && config.neighbour_share <= 1.0,
          "neighbour_share",
          "between 0 and 1");
  require(config.min_component_facets >= 0, "min_component_facets", "zero (keep all) or more");
  require(config.max_facet_edge_m > 0.0, "max_facet_edge_m", "positive");
  require(config.min_point_spacing_m > 0.0, "min_point_spacing_m", "positive");
}

class SpaceCarver::Impl {
 public:
  explicit Impl(const CarvingConfig& config)
      : config_(config),
        sites_(&rays_, config.min_point_spacing_m),
        steiner_(config.steiner_spacing_m, config.steiner_reach_m, config.steiner_clearance_m),
        field_(&rays_, {config.behind_distance_m, config.evidence_cap}) {}

  std::vector<FrameId> update(const std::vector<FrameId>& removed,
                              const std::vector<CarvingFrame>& added);
  void forget_beyond(const Eigen::Vector3d& center, double radius_m, std::size_t max_points);
  bool holds(FrameId id) const { return rays_.frames.contains(id) && rays_.frames[id].live > 0; }
  CarvedSurface extract_surface();
  CarvingStats stats() const;
  std::size_t bytes() const;
  std::size_t bytes_unused() const { return field_.bytes_unused(); }
  std::vector<CellEvidence> evidence() const;

 private:
  std::vector<RayId> take_out(const std::vector<FrameId>& ids);
  FrameId put_in(const CarvingFrame& frame);
  void note_sites(const SiteChanges& changes, FieldChange* change);
  void note_steiner(FieldChange* change);
  bool is_outside(const Site& site, const Eigen::Vector3d& center, double radius_m) const;

  CarvingConfig config_;
  RayStore rays_;
  Sites sites_;
  SteinerGrid steiner_;
  EvidenceField field_;
  GrowthStats growth_;
};

std::vector<FrameId> SpaceCarver::Impl::update(const std::vector<FrameId>& removed,
                                               const std::vector<CarvingFrame>& added) {
  std::for_each(added.begin(), added.end(), check_frame);
  const std::vector<RayId> gone = take_out(removed);
  std::vector<FrameId> ids;
  for (const CarvingFrame& frame : added) {
    ids.push_back(put_in(frame));
  }
  FieldChange change;
  const SiteChanges changes = sites_.take_changes();
  note_sites(changes, &change);
  note_steiner(&change);
  field_.apply(change);
  sites_.drop(change.removed);
  for (const RayId ray : gone) {
    rays_.erase(ray);
  }
  return ids;
}

std::vector<RayId> SpaceCarver::Impl::take_out(const std::vector<FrameId>& ids) {
  std::vector<RayId> gone;
  for (const FrameId id : std::set<FrameId>(ids.begin(), ids.end())) {
    if (!rays_.frames.contains(id)) {
      continue;
    }
    const RayFrame& frame = rays_.frames[id];
    steiner_.remove_sensor(frame.center);
    for (RayId ray = frame.first; ray < frame.first + frame.count; ++ray) {
      if (rays_.rays.contains(ray)) {
        gone.push_back(ray);
      }
    }
    if (frame.count == 0) {
      rays_.frames.erase(id);
    }
  }
  std::sort(gone.begin(), gone.end());
  sites_.remove(gone);
  return gone;
}

FrameId SpaceCarver::Impl::put_in(const CarvingFrame& frame) {
  RayFrame record;
  record.center = frame.center;
  record.eye = general_position(frame.center);
  record.count = static_cast<std::uint32_t>(frame.rays.size());
  record.live = record.count;
  const FrameId id = rays_.frames.push(record);
  steiner_.add_sensor(frame.center);
  for (std::size_t k = 0; k < frame.rays.size(); ++k) {
    const CarvingFrame::Ray& given = frame.rays[k];
    Ray ray;
    ray.offset = (given.point - frame.center).cast<float>();
    ray.sigma = given.sigma;
    ray.label = given.open ? kUnlabelled : given.label;
    ray.open = given.open;
    ray.frame = id;
    const RayId ray_id = rays_.rays.push(ray);
    if (k == 0) {
      rays_.frames[id].first = ray_id;
    }
    sites_.add(ray_id);
  }
  return id;
}

void SpaceCarver::Impl::note_sites(const SiteChanges& changes, FieldChange* change) {
  for (const SiteChanges::Switch& ray : changes.switched) {
    if (ray.from != kNoId) {
      change->withdrawn.push_back({ray.ray, ray.from});
    }
    if (ray.to != kNoId) {
      change->attached.push_back({ray.ray, ray.to});
    }
  }
  for (const SiteId site : changes.removed) {
    steiner_.remove_point(sites_[site].point);
    change->removed.push_back(site);
  }
  for (const SiteId site : changes.added) {
    steiner_.add_point(sites_[site].point);
    change->added.push_back({site, sites_[site].point});
  }
}

void SpaceCarver::Impl::note_steiner(FieldChange* change) {
  for (const SteinerGrid::Wish& wish : steiner_.take_wishes()) {
    if (wish.site != kNoId) {
      steiner_.set_site(wish.key, kNoId);
      sites_.remove_extra(wish.site);
      change->removed.push_back(wish.site);
    } else {
      const SiteId site = sites_.add_extra(wish.point);
      steiner_.set_site(wish.key, site);
      change->added.push_back({site, wish.point});
    }
  }
}

bool SpaceCarver::Impl::is_outside(const Site& site,
                                   const Eigen::Vector3d& center,
                                   double radius_m) const {
  if ((site.point - center).norm() <= radius_m) {
    return false;
  }
  return std::none_of(site.rays.begin(), site.rays.end(), [&](RayId id) {
    const Eigen::Vector3d& eye = rays_.frames[rays_.rays[id].frame].eye;
    return distance_to_segment(center, site.point, eye) <= radius_m;
  });
}

void SpaceCarver::Impl::forget_beyond(const Eigen::Vector3d& center,
                                      double radius_m,
                                      std::size_t max_points) {
  FieldChange change;
  change.center = center;
  change.exact_radius_m = radius_m;
  sites_.all().for_each_id([&](SiteId id) {
    if (change.removed.size() < max_points && sites_[id].founder != kNoId &&
        is_outside(sites_[id], center, radius_m)) {
      change.removed.push_back(id);
    }
  });
  for (const SiteId id : change.removed) {
    steiner_.remove_point(sites_[id].point);
    sites_.forget(id);
  }
  for (const SiteId id : steiner_.forget_beyond(center, radius_m)) {
    change.removed.push_back(id);
    sites_.remove_extra(id);
  }
  field_.apply(change);
}

CarvedSurface SpaceCarver::Impl::extract_surface() {
  growth_ = {};
  if (!field_.is_solid()) {
    return {};
  }
  classify_cells(&field_.triangulation(), config_);
  growth_ = FreeSpaceGrowth(&field_.triangulation()).update();
  return without_small_parts(make_surface(field_.triangulation(), config_.max_facet_edge_m),
                             static_cast<std::size_t>(config_.min_component_facets));
}

CarvingStats SpaceCarver::Impl::stats() const {
  CarvingStats stats;
  stats.vertices = field_.triangulation().number_of_vertices();
  stats.cells = field_.is_solid() ? field_.triangulation().number_of_finite_cells() : 0;
  stats.rays = rays_.rays.size();
  stats.free_cells = growth_.free_cells;
  stats.reached_cells = growth_.reached_cells;
  return stats;
}

std::size_t SpaceCarver::Impl::bytes() const {
  return rays_.rays.bytes() + rays_.frames.bytes() + sites_.bytes() + steiner_.bytes() +
         field_.bytes();
}

std::vector<CellEvidence> SpaceCarver::Impl::evidence() const {
  std::vector<CellEvidence> cells;
  if (!field_.is_solid()) {
    return cells;
  }
  const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  for (const CellHandle cell : field_.triangulation().finite_cell_handles()) {
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

std::vector<FrameId> SpaceCarver::update(const std::vector<FrameId>& removed,
                                         const std::vector<CarvingFrame>& added) {
  return impl_->update(removed, added);
}
void SpaceCarver::forget_beyond(const Eigen::Vector3d& center,
                                double radius_m,
                                std::size_t max_points) {
  impl_->forget_beyond(center, radius_m, max_points);
}
bool SpaceCarver::holds(FrameId id) const {
  return impl_->holds(id);
}
CarvedSurface SpaceCarver::extract_surface() {
  return impl_->extract_surface();
}
CarvingStats SpaceCarver::stats() const {
  return impl_->stats();
}
std::size_t SpaceCarver::bytes() const {
  return impl_->bytes();
}
std::size_t SpaceCarver::bytes_unused() const {
  return impl_->bytes_unused();
}
std::vector<CellEvidence> SpaceCarver::evidence() const {
  return impl_->evidence();
}

}  // namespace facet_mapping
