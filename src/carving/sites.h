// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Which points become vertices: a point nearer to an older vertex than its own spacing joins it.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "carving/point_index.h"
#include "carving/rays.h"

namespace facet_mapping::carving {

/// A vertex that points founded (or an extra one: no founder).
struct Site {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  RayId founder = kNoId;
  std::vector<RayId> rays;  ///< that end here, the founder's among them; no defined order
};

struct SiteChanges {
  struct Switch {
    RayId ray;
    SiteId from;  ///< kNoId: it gave no evidence before
    SiteId to;    ///< kNoId: it gives none now
  };
  std::vector<SiteId> added;
  std::vector<SiteId> removed;
  std::vector<Switch> switched;  ///< in ascending order of the rays
};

/// Rays of one frame to one site run through the same cells: the first of them speaks for all.
///
/// The choice is that of going through all rays in the order of their ids: a ray whose point has no
/// vertex of a smaller founder within its spacing founds one, else it joins the nearest. After any
/// sequence of add() and remove() it is what it would be had the removed rays never been there.
class Sites {
 public:
  Sites(RayStore* rays, double min_spacing_m);

  /// Points this far apart are one point.
  double spacing(const Ray& ray) const;

  /// Adds a ray with an id above all earlier ones. Call after the removals of the same batch.
  void add(RayId id);
  /// Takes rays out of the choice and decides anew for the others; the rays stay in the store.
  void remove(const std::vector<RayId>& ids);
  /// Drops a vertex and its rays without deciding anew for anybody: for what leaves the map.
  void forget(SiteId id);

  /// A vertex that no ray founds.
  SiteId add_extra(const Eigen::Vector3d& point);
  void remove_extra(SiteId id) { sites_.erase(id); }

  /// What changed since the last call. Removed sites still stand in the store until drop() is
  /// called with them.
  SiteChanges take_changes();
  void drop(const std::vector<SiteId>& removed);

  const Site& operator[](SiteId id) const { return sites_[id]; }
  bool contains(SiteId id) const { return sites_.contains(id); }
  const PagedStore<Site>& all() const { return sites_; }
  std::size_t bytes() const;

 private:
  SiteId nearest(const Eigen::Vector3d& point, double reach_m, RayId before) const;
  void note(RayId id);
  void detach(RayId id);
  void choose_active(SiteId id);
  void unsettle(RayId id);
  void settle();
  void decide(RayId id, bool hindsight);
  void found(RayId id, const Eigen::Vector3d& point);
  void dissolve(SiteId id);
  void unsettle_around(RayId founder, const Eigen::Vector3d& point);

  RayStore* store_;
  double min_spacing_m_;
  double max_spacing_m_;
  PointIndex index_;
  PagedStore<Site> sites_;
  std::priority_queue<RayId, std::vector<RayId>, std::greater<>> undecided_;
  std::unordered_map<RayId, SiteId> before_;  ///< where rays that changed gave evidence at first
  std::unordered_set<SiteId> touched_;        ///< sites that gained or lost rays
  std::vector<SiteId> added_;
  std::vector<SiteId> removed_;
};

}  // namespace facet_mapping::carving
