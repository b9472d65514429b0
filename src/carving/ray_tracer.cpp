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

bool RayTracer::target_of(const Ray& ray, VertexHandle vertex, bool behind, Point* target) const {
  const Point eye = to_point(store_.frames[ray.frame].eye);
  if (!behind) {
    *target = eye;
    return true;
  }
  const Kernel::Vector_3 away = vertex->point() - eye;
  const double length = std::sqrt(away.squared_length());
  *target = vertex->point() + away * (length > 0.0 ? behind_distance_m_ / length : 0.0);
  return ray.label != kUnlabelled && length > 0.0;
}

std::vector<std::vector<Hit>> RayTracer::trace(const RayEnd* first, std::size_t count) const {
  constexpr std::size_t kBundle = 128;
  std::vector<std::vector<Hit>> hits(count);
  tbb::parallel_for(std::size_t{0}, (count + kBundle - 1) / kBundle, [&](std::size_t bundle) {
    const std::size_t begin = bundle * kBundle;
    const std::size_t size = std::min(kBundle, count - begin);
    std::vector<std::vector<Hit>> part(size);
    for (std::vector<Hit>& list : part) {
      list.reserve(128);
    }
    trace_part(first + begin, size, false, &part);
    trace_part(first + begin, size, true, &part);
    std::move(part.begin(), part.end(), hits.begin() + static_cast<std::ptrdiff_t>(begin));
  });
  return hits;
}

void RayTracer::trace_part(const RayEnd* first,
                           std::size_t count,
                           bool behind,
                           std::vector<std::vector<Hit>>* hits) const {
  std::vector<VertexHandle> starts(count);
  std::vector<Point> targets(count);
  std::vector<Weigher> weighers(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Ray& ray = store_.rays[first[k].ray];
    starts[k] = vertices_.at(first[k].site);
    if (!target_of(ray, starts[k], behind, &targets[k])) {
      targets[k] = starts[k]->point();  // a walk of no length
    }
    weighers[k] = Weigher(starts[k]->point(), targets[k], ray.sigma);
  }
  walk_rays(
      triangulation_,
      count,
      [&](std::size_t k) { return starts[k]; },
      [&](std::size_t k) -> const Point& { return targets[k]; },
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
  if (rays.empty()) {
    return {};
  }
  std::vector<bool> wanted(rays.back() - rays.front() + 1, false);
  for (const RayId id : rays) {
    wanted[id - rays.front()] = true;
  }
  constexpr std::size_t kBlock = 256;
  const std::size_t cell_blocks = (cells.size() + kBlock - 1) / kBlock;
  const std::size_t ray_blocks = (rays.size() + kBlock - 1) / kBlock;
  std::vector<std::vector<RayHit>> hits(cell_blocks + ray_blocks);
  tbb::parallel_for(std::size_t{0}, hits.size(), [&](std::size_t block) {
    if (block < cell_blocks) {
      const std::size_t end = std::min(cells.size(), (block + 1) * kBlock);
      for (std::size_t k = block * kBlock; k < end; ++k) {
        enter_cell(cells[k], rays, wanted, &hits[block]);
      }
      return;
    }
    const std::size_t end = std::min(rays.size(), (block - cell_blocks + 1) * kBlock);
    for (std::size_t k = (block - cell_blocks) * kBlock; k < end; ++k) {
      start_ray(rays[k], &hits[block]);
    }
  });
  return hits;
}

void RayTracer::enter_cell(CellHandle cell,
                           const std::vector<RayId>& rays,
                           const std::vector<bool>& wanted,
                           std::vector<RayHit>* hits) const {
  for (int k = 0; k < 4; ++k) {
    const CellHandle old = cell->neighbor(k);
    if (old->info().is_new || triangulation_.is_infinite(old)) {
      continue;
    }
    const int facet = old->index(cell);
    for (const RayId id : old->info().rays) {
      const RayId index = id - rays.front();  // wraps around below the first
      if (index >= wanted.size() || !wanted[index]) {
        continue;
      }
      const Ray& ray = store_.rays[id];
      const VertexHandle vertex = vertices_.at(ray.site);
      for (const bool behind : {false, true}) {
        Point target;
        if (!target_of(ray, vertex, behind, &target)) {
          continue;
        }
        RayWalk walk = RayWalk::through(triangulation_, vertex, target, old, facet);
        if (!walk.done()) {
          walk.advance();
          follow(walk, id, behind, hits);
          break;
        }
      }
    }
  }
}

void RayTracer::start_ray(RayId id, std::vector<RayHit>* hits) const {
  const Ray& ray = store_.rays[id];
  const VertexHandle vertex = vertices_.at(ray.site);
  for (const bool behind : {false, true}) {
    Point target;
    if (target_of(ray, vertex, behind, &target)) {
      follow(RayWalk(triangulation_, vertex, target), id, behind, hits);
    }
  }
}

void RayTracer::follow(RayWalk walk, RayId id, bool behind, std::vector<RayHit>* hits) const {
  const Ray& ray = store_.rays[id];
  const VertexHandle vertex = vertices_.at(ray.site);
  Point target;
  target_of(ray, vertex, behind, &target);
  Weigher weigh(vertex->point(), target, ray.sigma);
  for (; !walk.done() && walk.cell()->info().is_new; walk.advance()) {
    hits->push_back({id,
                     {walk.cell(),
                      behind ? kRayWeight : weigh(walk),
                      behind ? Hit::Part::kBehind : Hit::Part::kFront}});
  }
  if (walk.done() && walk.left_hull()) {
    hits->push_back({id, {walk.cell(), 0, Hit::Part::kOutside}});
  }
}

}  // namespace facet_mapping::carving
