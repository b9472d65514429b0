// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/sites.h"

#include <algorithm>

namespace facet_mapping::carving {
namespace {

constexpr double kSpacingInSigmas = 0.5;  ///< points this much of their noise apart are one point
constexpr double kLargestSpacing = 16.0;  ///< in smallest spacings

}  // namespace

Sites::Sites(RayStore* rays, double min_spacing_m)
    : store_(rays),
      min_spacing_m_(min_spacing_m),
      max_spacing_m_(kLargestSpacing * min_spacing_m),
      index_(min_spacing_m, max_spacing_m_) {}

double Sites::spacing(const Ray& ray) const {
  return std::clamp(
      kSpacingInSigmas * static_cast<double>(ray.sigma), min_spacing_m_, max_spacing_m_);
}

SiteId Sites::nearest(const Eigen::Vector3d& point, double reach_m, RayId before) const {
  SiteId nearest = kNoId;
  double least = reach_m;
  RayId oldest = 0;
  index_.for_each_near(point, reach_m, [&](const PointIndex::Entry& entry, double distance) {
    const RayId founder = sites_[entry.id].founder;
    if (founder < before && (distance < least || (distance == least && founder < oldest))) {
      least = distance;
      nearest = entry.id;
      oldest = founder;
    }
  });
  return nearest;
}

void Sites::add(RayId id) {
  note(id);
  decide(id, false);
}

void Sites::remove(const std::vector<RayId>& ids) {
  for (const RayId id : ids) {
    const SiteId site = store_->rays[id].site;
    note(id);
    if (site == kNoId) {
      continue;  // went with its founder, which was removed before it
    }
    detach(id);
    if (sites_[site].founder == id) {
      dissolve(site);
    }
  }
  // What dissolved put up for a decision may have been removed after that.
  std::vector<RayId> gone = ids;
  std::sort(gone.begin(), gone.end());
  std::priority_queue<RayId, std::vector<RayId>, std::greater<>> left;
  for (; !undecided_.empty(); undecided_.pop()) {
    if (!std::binary_search(gone.begin(), gone.end(), undecided_.top())) {
      left.push(undecided_.top());
    }
  }
  undecided_.swap(left);
  settle();
}

void Sites::note(RayId id) {
  const Ray& ray = store_->rays[id];
  before_.emplace(id, ray.active ? ray.site : kNoId);
}

void Sites::detach(RayId id) {
  Ray& ray = store_->rays[id];
  touched_.insert(ray.site);
  std::vector<RayId>& rays = sites_[ray.site].rays;
  rays.erase(std::find(rays.begin(), rays.end(), id));
  ray.site = kNoId;
  ray.active = false;
}

void Sites::unsettle(RayId id) {
  note(id);
  detach(id);
  undecided_.push(id);
}

void Sites::dissolve(SiteId id) {
  const std::vector<RayId> rays = sites_[id].rays;
  for (const RayId ray : rays) {
    unsettle(ray);
  }
  index_.erase(sites_[id].point, id);
  removed_.push_back(id);
}

void Sites::settle() {
  while (!undecided_.empty()) {
    const RayId id = undecided_.top();
    undecided_.pop();
    decide(id, true);
  }
}

void Sites::decide(RayId id, bool hindsight) {
  Ray& ray = store_->rays[id];
  const Eigen::Vector3d point = store_->point(ray);
  const SiteId near = nearest(point, spacing(ray), id);
  if (near == kNoId) {
    if (hindsight) {
      unsettle_around(id, point);
    }
    found(id, point);
  } else {
    ray.site = near;
    sites_[near].rays.push_back(id);
    touched_.insert(near);
  }
}

void Sites::found(RayId id, const Eigen::Vector3d& point) {
  const SiteId site = sites_.push({point, id, {id}});
  store_->rays[id].site = site;
  index_.insert(point, site);
  added_.push_back(site);
  touched_.insert(site);
}

// A vertex founded in hindsight forbids younger ones within their founders' spacing, and draws
// younger points that are nearer to it than to the vertex they joined.
void Sites::unsettle_around(RayId founder, const Eigen::Vector3d& point) {
  std::vector<SiteId> near;
  index_.for_each_near(
      point, 2.0 * max_spacing_m_, [&](const PointIndex::Entry& entry, double /*distance*/) {
        near.push_back(entry.id);
      });
  for (const SiteId id : near) {
    const Ray& other = store_->rays[sites_[id].founder];
    if (sites_[id].founder > founder && (sites_[id].point - point).norm() < spacing(other)) {
      dissolve(id);
      continue;
    }
    const std::vector<RayId> rays = sites_[id].rays;
    for (const RayId ray_id : rays) {
      const Ray& ray = store_->rays[ray_id];
      const Eigen::Vector3d p = store_->point(ray);
      const double distance = (p - point).norm();
      if (ray_id > founder && ray_id != sites_[id].founder && distance < spacing(ray) &&
          distance <= (p - sites_[id].point).norm()) {
        unsettle(ray_id);
      }
    }
  }
}

void Sites::forget(SiteId id) {
  index_.erase(sites_[id].point, id);
  for (const RayId ray : sites_[id].rays) {
    store_->erase(ray);
  }
  sites_.erase(id);
}

SiteId Sites::add_extra(const Eigen::Vector3d& point) {
  return sites_.push({point, kNoId, {}});
}

void Sites::choose_active(SiteId id) {
  std::vector<RayId> rays = sites_[id].rays;
  std::sort(rays.begin(), rays.end());
  std::unordered_set<FrameId> frames;
  for (const RayId ray_id : rays) {
    Ray& ray = store_->rays[ray_id];
    const bool is_first = frames.insert(ray.frame).second;
    if (ray.active != is_first) {
      note(ray_id);
      ray.active = is_first;
    }
  }
}

SiteChanges Sites::take_changes() {
  SiteChanges changes;
  for (const SiteId site : touched_) {
    if (sites_.contains(site)) {
      choose_active(site);
    }
  }
  touched_.clear();
  for (const auto& [ray, from] : before_) {
    const SiteId to = store_->rays[ray].active ? store_->rays[ray].site : kNoId;
    if (from != to) {
      changes.switched.push_back({ray, from, to});
    }
  }
  std::sort(changes.switched.begin(), changes.switched.end(), [](const auto& a, const auto& b) {
    return a.ray < b.ray;
  });
  changes.added.swap(added_);
  changes.removed.swap(removed_);
  before_.clear();
  return changes;
}

void Sites::drop(const std::vector<SiteId>& removed) {
  for (const SiteId id : removed) {
    sites_.erase(id);
  }
}

std::size_t Sites::bytes() const {
  constexpr std::size_t kBlock = 16;  // what the allocator adds to a small block
  std::size_t bytes = sites_.bytes() + index_.bytes();
  sites_.for_each_id(
      [&](SiteId id) { bytes += sites_[id].rays.capacity() * sizeof(RayId) + kBlock; });
  return bytes;
}

}  // namespace facet_mapping::carving
