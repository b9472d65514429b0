// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cells per second of the ray walk and of CGAL's segment traverser, over the same rays.
#include <algorithm>
#include <iterator>
#include <vector>

#include "benchmark/processor_time.h"
#include "benchmark/street_scans.h"
#include "carving/ray_bundle.h"
#include "support/crossed_cells.h"
#include <benchmark/benchmark.h>

namespace facet_mapping::benchmarking {
namespace {

using carving::CellHandle;
using carving::Point;
using carving::RayWalk;
using carving::Triangulation;
using carving::VertexHandle;

constexpr std::size_t kTracedFrames = 4;

struct TracedRay {
  VertexHandle vertex;
  Point center;
};

struct Scene {
  Triangulation triangulation;
  std::vector<TracedRay> rays;
};

Point to_point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

// As the map does it: points in the order of the drive, each located from the last one's cell.
std::vector<std::vector<TracedRay>> insert_points(const std::vector<CarvingFrame>& frames,
                                                  Triangulation* triangulation) {
  std::vector<std::vector<TracedRay>> rays(frames.size());
  CellHandle hint;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (const CarvingFrame::Ray& ray : frames[k].rays) {
      const VertexHandle vertex = triangulation->insert(to_point(ray.point), hint);
      hint = vertex->cell();
      rays[k].push_back({vertex, to_point(frames[k].center)});
    }
  }
  return rays;
}

// The rays of a few whole frames, spread over the drive, in the order in which the map traces them.
Scene make_scene(std::size_t points) {
  Scene scene;
  const auto rays = insert_points(street_scans(points), &scene.triangulation);
  const std::size_t traced = std::min(kTracedFrames, rays.size());
  for (std::size_t k = 0; k < traced; ++k) {
    const std::vector<TracedRay>& frame = rays[(2 * k + 1) * rays.size() / (2 * traced)];
    scene.rays.insert(scene.rays.end(), frame.begin(), frame.end());
  }
  return scene;
}

using Cells = std::vector<CellHandle>;

void walk_cells(const Scene& scene, const TracedRay& ray, Cells* cells) {
  for (RayWalk walk(scene.triangulation, ray.vertex, ray.center); !walk.done(); walk.advance()) {
    cells->push_back(walk.cell());
  }
}

void traverse_cells(const Scene& scene, const TracedRay& ray, Cells* cells) {
  auto at = scene.triangulation.segment_traverser_cells_begin(
      ray.vertex->point(), ray.center, ray.vertex->cell());
  for (; at != scene.triangulation.segment_traverser_cells_end(); ++at) {
    cells->push_back(at);
  }
}

/// Cells per second of processor time, one entry a run: other programs may be running.
using Paces = std::vector<double>;

double median(Paces paces) {
  std::nth_element(paces.begin(), paces.begin() + paces.size() / 2, paces.end());
  return paces[paces.size() / 2];
}

// The cells of a block of rays, as the map keeps them until they are applied.
constexpr std::size_t kBlock = 2048;
using Block = std::vector<Cells>;

void walk_block(const Scene& scene, std::size_t begin, std::size_t end, Block* cells) {
  carving::walk_rays(
      scene.triangulation,
      end - begin,
      [&](std::size_t k) { return scene.rays[begin + k].vertex; },
      [&](std::size_t k) -> const Point& { return scene.rays[begin + k].center; },
      [&](std::size_t k, const RayWalk& walk) { (*cells)[k].push_back(walk.cell()); });
}

void walk_block_singly(const Scene& scene, std::size_t begin, std::size_t end, Block* cells) {
  for (std::size_t k = begin; k < end; ++k) {
    walk_cells(scene, scene.rays[k], &(*cells)[k - begin]);
  }
}

void traverse_block(const Scene& scene, std::size_t begin, std::size_t end, Block* cells) {
  for (std::size_t k = begin; k < end; ++k) {
    traverse_cells(scene, scene.rays[k], &(*cells)[k - begin]);
  }
}

template <typename Trace>
double cells_per_second(const Scene& scene, const Trace& trace) {
  static Block cells(kBlock);
  std::size_t count = 0;
  const double start = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
  for (std::size_t begin = 0; begin < scene.rays.size(); begin += kBlock) {
    for (Cells& ray : cells) {
      ray.clear();
    }
    trace(scene, begin, std::min(begin + kBlock, scene.rays.size()), &cells);
    for (const Cells& ray : cells) {
      count += ray.size();
    }
  }
  return static_cast<double>(count) / (processor_seconds(CLOCK_THREAD_CPUTIME_ID) - start);
}

struct Comparison {
  double wrong = 0.0;  ///< cells crossed but not visited by one of the two, or visited but not met
  double touched = 0.0;  ///< cells that only one of the two visits and the segment only touches
};

// Cells in one list only: crossed means that the other missed one.
void compare(const Scene& scene, const TracedRay& ray, Comparison* result) {
  Cells walked;
  Cells traversed;
  walk_cells(scene, ray, &walked);
  traverse_cells(scene, ray, &traversed);
  std::sort(walked.begin(), walked.end());
  std::sort(traversed.begin(), traversed.end());
  Cells different;
  std::set_symmetric_difference(walked.begin(),
                                walked.end(),
                                traversed.begin(),
                                traversed.end(),
                                std::back_inserter(different));
  for (const CellHandle cell : different) {
    const bool touches =
        scene.triangulation.is_infinite(cell) ||
        testing::meeting(ray.vertex->point(), ray.center, cell) == testing::Meeting::kTouches;
    (touches ? result->touched : result->wrong) += 1.0;
  }
}

Comparison compare_all(const Scene& scene) {
  Comparison comparison;
  for (const TracedRay& ray : scene.rays) {
    compare(scene, ray, &comparison);
  }
  return comparison;
}

double mean_cells(const Scene& scene) {
  Cells cells;
  for (const TracedRay& ray : scene.rays) {
    walk_cells(scene, ray, &cells);
  }
  return static_cast<double>(cells.size()) / static_cast<double>(scene.rays.size());
}

void trace_rays(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<std::size_t>(state.range(0)));
  Paces walk;
  Paces single;
  Paces traverser;
  Paces ratio;
  for (auto _ : state) {
    traverser.push_back(cells_per_second(scene, traverse_block));
    single.push_back(cells_per_second(scene, walk_block_singly));
    walk.push_back(cells_per_second(scene, walk_block));
    ratio.push_back(walk.back() / traverser.back());
  }
  const Comparison comparison = compare_all(scene);
  state.counters["rays"] = static_cast<double>(scene.rays.size());
  state.counters["cells_per_ray"] = mean_cells(scene);
  state.counters["cells_per_s"] = median(walk);
  state.counters["singly_cells_per_s"] = median(single);
  state.counters["cgal_cells_per_s"] = median(traverser);
  state.counters["ratio"] = median(ratio);
  state.counters["only_touched"] = comparison.touched;
  state.counters["wrong_cells"] = comparison.wrong;
  if (comparison.wrong > 0.0) {
    state.SkipWithError("the walk and the traverser visit different cells");
  }
}

BENCHMARK(trace_rays)
    ->Name("trace")
    ->Arg(2000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace facet_mapping::benchmarking
