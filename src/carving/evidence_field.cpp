// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/evidence_field.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

namespace facet_mapping::carving {
namespace {

constexpr std::size_t kTraceBlock = 4096;  ///< rays; bounds the memory of hits not yet entered

/// Sorts along a space-filling curve, so that each insertion starts near the last.
void sort_in_space(std::vector<NewVertex>* vertices) {
  std::vector<std::pair<Point, std::size_t>> order;
  order.reserve(vertices->size());
  for (const NewVertex& vertex : *vertices) {
    order.emplace_back(to_point(vertex.point), order.size());
  }
  using Map = CGAL::First_of_pair_property_map<std::pair<Point, std::size_t>>;
  CGAL::hilbert_sort(
      order.begin(), order.end(), CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>());
  std::vector<NewVertex> sorted;
  sorted.reserve(order.size());
  for (const auto& [point, index] : order) {
    sorted.push_back((*vertices)[index]);
  }
  vertices->swap(sorted);
}

}  // namespace

void EvidenceField::apply(const FieldChange& change) {
  ++epoch_;
  const bool was_solid = is_solid();
  if (was_solid) {
    withdraw(change.withdrawn);
  }
  uncount(change.withdrawn);
  for (const SiteId site : change.removed) {
    remove_vertex(site, change);
  }
  const bool stayed_solid = was_solid && is_solid();
  add_vertices(change.added);
  attach(change.attached);
  if (!stayed_solid) {
    forget_evidence();
  }
  if (is_solid()) {
    trace();
  }
}

void EvidenceField::withdraw(const std::vector<RayEnd>& ends) {
  for (std::size_t begin = 0; begin < ends.size(); begin += kTraceBlock) {
    const std::size_t count = std::min(kTraceBlock, ends.size() - begin);
    const auto hits = tracer().trace(ends.data() + begin, count);
    for (std::size_t k = 0; k < count; ++k) {
      for (const Hit& hit : hits[k]) {
        take(ends[begin + k].ray, hit);
      }
    }
  }
}

void EvidenceField::uncount(const std::vector<RayEnd>& ends) {
  for (const RayEnd& end : ends) {
    const Ray& ray = store_.rays[end.ray];
    VertexInfo& vertex = vertices_.at(end.site)->info();
    vertex.rays -= ray.open ? 0 : 1;
    if (ray.label != kUnlabelled) {
      vertex.labels.subtract(ray.label, kRayWeight);
    }
  }
}

/// True if evidence counts in a cell. (Cells far outside the ball are not worth their rays.)
bool EvidenceField::is_exact(CellHandle cell, const FieldChange& change) const {
  if (!std::isfinite(change.exact_radius_m)) {
    return true;
  }
  const Point center = to_point(change.center);
  const double limit = change.exact_radius_m * change.exact_radius_m;
  for (int k = 0; k < 4; ++k) {
    const VertexHandle vertex = cell->vertex(k);
    if (!triangulation_.is_infinite(vertex) &&
        CGAL::squared_distance(vertex->point(), center) <= limit) {
      return true;
    }
  }
  return false;
}

void EvidenceField::remove_vertex(SiteId site, const FieldChange& change) {
  const auto at = vertices_.find(site);
  const VertexHandle vertex = at->second;
  if (is_solid()) {
    std::vector<CellHandle> star;
    triangulation_.incident_cells(vertex, std::back_inserter(star));
    for (const CellHandle cell : star) {
      if (!is_exact(cell, change)) {
        cell->info().rays.clear();
      }
      destroy(cell);
    }
    // Some neighbour that stays; its cell is known again after the removal.
    const CellHandle cell = star.front();
    const VertexHandle next = cell->vertex(cell->vertex(0) == vertex ? 1 : 0);
    triangulation_.remove(vertex);
    hint_ = next->cell();
  } else {
    triangulation_.remove(vertex);
    hint_ = CellHandle();
  }
  vertices_.erase(at);
}

void EvidenceField::add_vertices(std::vector<NewVertex> vertices) {
  sort_in_space(&vertices);
  for (const NewVertex& added : vertices) {
    const VertexHandle vertex = add_vertex(to_point(added.point));
    vertex->info().id = added.site;
    vertices_[added.site] = vertex;
  }
}

VertexHandle EvidenceField::add_vertex(const Point& point) {
  if (!is_solid()) {
    hint_ = CellHandle();
    return triangulation_.insert(point);
  }
  Triangulation::Locate_type type{};
  int i = 0;
  int j = 0;
  const CellHandle located = triangulation_.locate(point, type, i, j, hint_);
  if (type == Triangulation::VERTEX) {  // an extra vertex in the very place: never two in one
    constexpr double kApart = 1e-6;
    return add_vertex(Point(point.x() + kApart, point.y() - kApart, point.z() + kApart));
  }
  std::vector<CellHandle> conflicts;
  std::vector<Triangulation::Facet> border;
  triangulation_.find_conflicts(
      point, located, std::back_inserter(border), std::back_inserter(conflicts));
  for (const CellHandle cell : conflicts) {
    destroy(cell);
  }
  const VertexHandle vertex = triangulation_.insert_in_hole(
      point, conflicts.begin(), conflicts.end(), border.front().first, border.front().second);
  hint_ = vertex->cell();
  return vertex;
}

/// The rays of a cell that is about to go must be traced again.
void EvidenceField::destroy(CellHandle cell) {
  set_free(cell, false);
  mark_dirty(cell);
  for (const RayId id : cell->info().rays) {
    if (!store_.rays.contains(id)) {
      continue;  // forgotten
    }
    Ray& ray = store_.rays[id];
    if (ray.active && ray.epoch != epoch_) {
      ray.epoch = epoch_;
      retrace_.push_back(id);
    }
  }
}

void EvidenceField::attach(const std::vector<RayEnd>& ends) {
  for (const RayEnd& end : ends) {
    Ray& ray = store_.rays[end.ray];
    VertexInfo& vertex = vertices_.at(end.site)->info();
    vertex.rays += ray.open ? 0 : 1;
    if (ray.label != kUnlabelled) {
      vertex.labels.add(ray.label, kRayWeight);
    }
    ray.fresh = true;
    if (ray.epoch != epoch_) {
      ray.epoch = epoch_;
      retrace_.push_back(end.ray);
    }
  }
}

// While all points lie in a plane there are no cells; with the first or the last of them all rays
// are traced, or none.
void EvidenceField::forget_evidence() {
  retrace_.clear();
  if (is_solid()) {
    for (const CellHandle cell : triangulation_.all_cell_handles()) {
      cell->info() = CellInfo{};
    }
  }
  for (const VertexHandle vertex : triangulation_.all_vertex_handles()) {
    vertex->info().free_cells = 0;
    vertex->info().is_dirty = true;
  }
  store_.rays.for_each_id([this](RayId id) {
    if (!store_.rays[id].active) {
      return;
    }
    store_.rays[id].fresh = true;
    store_.rays[id].epoch = epoch_;
    retrace_.push_back(id);
  });
}

void EvidenceField::trace() {
  std::vector<RayEnd> fresh;
  std::vector<RayId> old;
  std::sort(retrace_.begin(), retrace_.end());
  for (const RayId id : retrace_) {
    if (store_.rays[id].fresh) {
      fresh.push_back({id, store_.rays[id].site});
    } else {
      old.push_back(id);
    }
  }
  std::vector<CellHandle> new_cells;
  for (const CellHandle cell : triangulation_.all_cell_handles()) {
    if (cell->info().is_new) {
      new_cells.push_back(cell);
    }
  }
  for (const auto& block : tracer().trace_new_cells(new_cells, old)) {
    for (const auto& [id, hit] : block) {
      put(id, hit);
    }
  }
  trace_fresh(fresh);
  for (const CellHandle cell : new_cells) {
    cell->info().is_new = false;
  }
  retrace_.clear();
}

void EvidenceField::trace_fresh(const std::vector<RayEnd>& ends) {
  for (std::size_t begin = 0; begin < ends.size(); begin += kTraceBlock) {
    const std::size_t count = std::min(kTraceBlock, ends.size() - begin);
    const auto hits = tracer().trace(ends.data() + begin, count);
    for (std::size_t k = 0; k < count; ++k) {
      for (const Hit& hit : hits[k]) {
        put(ends[begin + k].ray, hit);
      }
      store_.rays[ends[begin + k].ray].fresh = false;
    }
  }
}

bool EvidenceField::weighs_anew(const CellInfo& cell, Weight free_after) const {
  // Above the cap more free space weighs no more, but what speaks for matter weighs less.
  const auto cap = static_cast<Weight>(config_.cap_rays * kRayWeight);
  return !cell.labels.empty() || std::min(cell.free, cap) != std::min(free_after, cap);
}

void EvidenceField::put(RayId id, const Hit& hit) {
  CellInfo& cell = hit.cell->info();
  if (hit.part == Hit::Part::kFront) {
    cell.is_changed |= weighs_anew(cell, cell.free + hit.weight);
    cell.free += hit.weight;
  } else if (hit.part == Hit::Part::kBehind) {
    cell.labels.add(store_.rays[id].label, hit.weight);
    cell.is_changed = true;
  } else if (std::find(cell.rays.begin(), cell.rays.end(), id) != cell.rays.end()) {
    return;  // of the infinite cells at a vertex a ray may leave by one or another
  }
  cell.rays.push_back(id);
}

void EvidenceField::take(RayId id, const Hit& hit) {
  CellInfo& cell = hit.cell->info();
  if (hit.part == Hit::Part::kFront) {
    cell.is_changed |= weighs_anew(cell, cell.free - hit.weight);
    cell.free -= hit.weight;
  } else if (hit.part == Hit::Part::kBehind) {
    cell.labels.subtract(store_.rays[id].label, hit.weight);
    cell.is_changed = true;
  }
  const auto at = std::find(cell.rays.begin(), cell.rays.end(), id);
  if (at != cell.rays.end()) {
    *at = cell.rays.back();
    cell.rays.pop_back();
  }
}

std::size_t EvidenceField::bytes_unused() const {
  const auto& tds = triangulation_.tds();
  return (tds.cells().capacity() - tds.cells().size()) * sizeof(Tds::Cell) +
         (tds.vertices().capacity() - tds.vertices().size()) * sizeof(Tds::Vertex);
}

std::size_t EvidenceField::bytes() const {
  constexpr std::size_t kBlock = 16;     // what the allocator adds to a small block
  constexpr std::size_t kMapEntry = 40;  // a node and its bucket in the map of vertices
  const auto& tds = triangulation_.tds();
  std::size_t bytes = tds.cells().capacity() * sizeof(Tds::Cell) +
                      tds.vertices().capacity() * sizeof(Tds::Vertex) +
                      vertices_.size() * kMapEntry;
  const auto add = [&bytes](std::size_t heap) { bytes += heap == 0 ? 0 : heap + kBlock; };
  for (const Tds::Cell& cell : tds.cells()) {
    add(cell.info().rays.capacity() * sizeof(RayId));
    add(cell.info().labels.bytes());
  }
  for (const Tds::Vertex& vertex : tds.vertices()) {
    add(vertex.info().labels.bytes());
  }
  return bytes;
}

}  // namespace facet_mapping::carving
