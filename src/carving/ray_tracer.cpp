// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/ray_tracer.h"

#include <algorithm>
#include <cmath>

#include "carving/ray_bundle.h"
#include <tbb/parallel_for.h>

namespace facet_mapping::carving {

/// Free-space weight in the cells of one ray, which it reaches in any order.
class RayTracer::Weigher {
 public:
  Weigher() = default;
  Weigher(const Point& source, const Point& target, float sigma)
      : source_(source),
        target_(target),
        length_(std::sqrt(CGAL::squared_distance(source, target))),
        sigma_(sigma) {}

  Weight operator()(const RayWalk& walk) {
    if (!is_full_) {
      const double reach =
          walk.at_target() ? length_
                           : distance_to_facet(walk.cell(), walk.exit_facet(), source_, target_);
      weight_ = soft_weight(reach, sigma_);
      is_full_ = weight_ == kRayWeight;  // and so is all that comes later
    }
    return weight_;
  }

 private:
  Point source_;
  Point target_;
  double length_ = 0.0;
  double sigma_ = 0.0;
  Weight weight_ = 0;
  bool is_full_ = false;
};

/// Rays to be looked up by their ids.
class RayTracer::RayList {
 public:
  RayList(const RayTracer& tracer, const std::vector<RayId>& sorted_ids) {
    if (sorted_ids.empty()) {
      return;
    }
    first_ = sorted_ids.front();
    slots_.assign(sorted_ids.back() - first_ + 1, kNoId);
    rays_.reserve(sorted_ids.size());
    for (const RayId id : sorted_ids) {
      slots_[id - first_] = static_cast<std::uint32_t>(rays_.size());
      rays_.push_back(tracer.segments({id, tracer.store_.rays[id].site}));
    }
  }

  /// Null if the ray is not of the list.
  const Segments* find(RayId id) const {
    const RayId index = id - first_;  // wraps around below the first
    return index < slots_.size() && slots_[index] != kNoId ? &rays_[slots_[index]] : nullptr;
  }
  const std::vector<Segments>& rays() const { return rays_; }

 private:
  RayId first_ = 0;
  std::vector<std::uint32_t> slots_;
  std::vector<Segments> rays_;
};

namespace {

/// Quick, safe test whether a segment can cross a facet outward.
class FacetSide {
 public:
  FacetSide(CellHandle cell, int facet) : corner_(at(cell, (facet + 1) & 3)) {
    const Eigen::Vector3d ab = at(cell, (facet + 2) & 3) - corner_;
    const Eigen::Vector3d ac = at(cell, (facet + 3) & 3) - corner_;
    normal_ = ab.cross(ac);
    if (normal_.dot(at(cell, facet) - corner_) > 0.0) {
      normal_ = -normal_;
    }
    constexpr double kRelativeError = 1e-12;  // far above what rounding can do
    error_ = kRelativeError * ab.lpNorm<1>() * ac.lpNorm<1>();
  }

  /// False only if `from` is surely beyond the facet's plane or `to` surely before it.
  bool may_cross(const Point& from, const Point& to) const {
    return height(from, -1.0) <= 0.0 && height(to, 1.0) >= 0.0;
  }

 private:
  static Eigen::Vector3d at(CellHandle cell, int k) { return to_vector(cell->vertex(k)->point()); }
  static Eigen::Vector3d to_vector(const Point& p) { return {p.x(), p.y(), p.z()}; }
  double height(const Point& point, double sign) const {
    const Eigen::Vector3d p = to_vector(point) - corner_;
    return normal_.dot(p) + sign * error_ * p.lpNorm<1>();
  }

  Eigen::Vector3d corner_;
  Eigen::Vector3d normal_;
  double error_;
};

}  // namespace

RayTracer::Segments RayTracer::segments(const RayEnd& end) const {
  const Ray& ray = store_.rays[end.ray];
  const VertexHandle vertex = vertices_.at(end.site);
  const Point source = vertex->point();
  const Point eye = to_point(store_.frames[ray.frame].eye);
  const Kernel::Vector_3 away = source - eye;
  const double length = std::sqrt(away.squared_length());
  const bool has_behind = !ray.open && length > 0.0;
  const Point behind = has_behind ? source + away * (behind_distance_m_ / length) : source;
  return {end.ray, ray.sigma, has_behind, vertex, source, {eye, behind}};
}

std::vector<std::vector<Hit>> RayTracer::trace(const RayEnd* first, std::size_t count) const {
  constexpr std::size_t kBundle = 128;
  std::vector<std::vector<Hit>> hits(count);
  tbb::parallel_for(std::size_t{0}, (count + kBundle - 1) / kBundle, [&](std::size_t bundle) {
    const std::size_t begin = bundle * kBundle;
    const std::size_t size = std::min(kBundle, count - begin);
    std::vector<Segments> rays(size);
    std::vector<std::vector<Hit>> part(size);
    for (std::size_t k = 0; k < size; ++k) {
      rays[k] = segments(first[begin + k]);
      part[k].reserve(128);
    }
    trace_part(rays, false, &part);
    trace_part(rays, true, &part);
    std::move(part.begin(), part.end(), hits.begin() + static_cast<std::ptrdiff_t>(begin));
  });
  return hits;
}

void RayTracer::trace_part(const std::vector<Segments>& rays,
                           bool behind,
                           std::vector<std::vector<Hit>>* hits) const {
  std::vector<Weigher> weighers(rays.size());
  for (std::size_t k = 0; k < rays.size(); ++k) {
    weighers[k] = Weigher(rays[k].source, rays[k].targets[behind ? 1 : 0], rays[k].sigma);
  }
  walk_rays(
      triangulation_,
      rays.size(),
      [&](std::size_t k) { return rays[k].vertex; },
      [&](std::size_t k) -> const Point& { return rays[k].targets[behind ? 1 : 0]; },
      [&](std::size_t k, const RayWalk& walk) {
        (*hits)[k].push_back({walk.cell(),
                              behind ? kRayWeight : weighers[k](walk),
                              behind ? Hit::Part::kBehind : Hit::Part::kFront});
      },
      [&](std::size_t k, const RayWalk& walk) {
        if (walk.left_hull()) {
          (*hits)[k].push_back({walk.cell(), 0, Hit::Part::kOutside});
        }
      });
}

std::vector<std::vector<RayHit>> RayTracer::trace_new_cells(const std::vector<CellHandle>& cells,
                                                            const std::vector<RayId>& rays) const {
  const RayList list(*this, rays);
  constexpr std::size_t kBlock = 256;
  const std::size_t cell_blocks = rays.empty() ? 0 : (cells.size() + kBlock - 1) / kBlock;
  const std::size_t ray_blocks = (rays.size() + kBlock - 1) / kBlock;
  std::vector<std::vector<RayHit>> hits(cell_blocks + ray_blocks);
  tbb::parallel_for(std::size_t{0}, hits.size(), [&](std::size_t block) {
    if (block < cell_blocks) {
      const std::size_t end = std::min(cells.size(), (block + 1) * kBlock);
      for (std::size_t k = block * kBlock; k < end; ++k) {
        enter_cell(cells[k], list, &hits[block]);
      }
      return;
    }
    const std::size_t end = std::min(rays.size(), (block - cell_blocks + 1) * kBlock);
    for (std::size_t k = (block - cell_blocks) * kBlock; k < end; ++k) {
      start_ray(list.rays()[k], &hits[block]);
    }
  });
  return hits;
}

void RayTracer::enter_cell(CellHandle cell, const RayList& rays, std::vector<RayHit>* hits) const {
  for (int k = 0; k < 4; ++k) {
    const CellHandle old = cell->neighbor(k);
    if (!old->info().is_new && !triangulation_.is_infinite(old)) {
      enter_through(old, old->index(cell), rays, hits);
    }
  }
}

void RayTracer::enter_through(CellHandle old,
                              int facet,
                              const RayList& rays,
                              std::vector<RayHit>* hits) const {
  const FacetSide side(old, facet);
  for (const RayId id : old->info().rays) {
    const Segments* ray = rays.find(id);
    if (ray == nullptr) {
      continue;
    }
    for (const bool behind : {false, true}) {
      const Point& target = ray->targets[behind ? 1 : 0];
      if (!side.may_cross(ray->source, target)) {
        continue;
      }
      RayWalk walk = RayWalk::through(triangulation_, ray->vertex, target, old, facet);
      if (!walk.done()) {
        walk.advance();
        follow(walk, *ray, behind, hits);
        break;
      }
    }
  }
}

void RayTracer::start_ray(const Segments& ray, std::vector<RayHit>* hits) const {
  follow(RayWalk(triangulation_, ray.vertex, ray.targets[0]), ray, false, hits);
  if (ray.has_behind) {
    follow(RayWalk(triangulation_, ray.vertex, ray.targets[1]), ray, true, hits);
  }
}

void RayTracer::follow(RayWalk walk,
                       const Segments& ray,
                       bool behind,
                       std::vector<RayHit>* hits) const {
  Weigher weigh(ray.source, ray.targets[behind ? 1 : 0], ray.sigma);
  for (; !walk.done() && walk.cell()->info().is_new; walk.advance()) {
    hits->push_back({ray.ray,
                     {walk.cell(),
                      behind ? kRayWeight : weigh(walk),
                      behind ? Hit::Part::kBehind : Hit::Part::kFront}});
  }
  if (walk.done() && walk.left_hull()) {
    hits->push_back({ray.ray, {walk.cell(), 0, Hit::Part::kOutside}});
  }
}

}  // namespace facet_mapping::carving
