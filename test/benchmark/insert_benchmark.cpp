// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One batch of points, each with three rays, through the carver: time and memory.
#include <memory>
#include <vector>

#include "benchmark/street_scans.h"
#include <benchmark/benchmark.h>
#include <sys/resource.h>

namespace facet_mapping::benchmarking {
namespace {

constexpr int kRaysPerPoint = 3;
constexpr double kMib = 1024.0;  // ru_maxrss is in KiB

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kMib;
}

// The peak is the process's: run this benchmark alone (--benchmark_filter=insert/1000000).
void insert_and_trace(benchmark::State& state) {
  const std::vector<CarvingFrame> frames =
      seen_from_neighbours(street_scans(static_cast<std::size_t>(state.range(0))), kRaysPerPoint);
  CarvingConfig config;
  config.min_point_spacing_m = 1e-6;  // every point becomes a vertex
  const double before = peak_memory_mib();
  CarvingStats stats;
  for (auto _ : state) {
    auto carver = std::make_unique<SpaceCarver>(config);
    carver->insert(frames);
    stats = carver->stats();
    state.PauseTiming();
    carver.reset();
    state.ResumeTiming();
  }
  state.counters["vertices"] = static_cast<double>(stats.vertices);
  state.counters["cells"] = static_cast<double>(stats.cells);
  state.counters["rays"] = static_cast<double>(stats.rays);
  state.counters["input_mib"] = before;
  state.counters["peak_mib"] = peak_memory_mib();
}

BENCHMARK(insert_and_trace)
    ->Name("insert")
    ->Arg(2000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace facet_mapping::benchmarking

BENCHMARK_MAIN();
