// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parallel work whose results are combined in a fixed order.
#pragma once

#include <cstddef>

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace facet_mapping {

/// Calls `work(k)` for k = 0 .. count - 1 in parallel and `combine(k, result)` in ascending order,
/// one at a time: floating-point sums are the same whatever the number of threads, and only as many
/// results as there are threads (and a few more) exist at once.
template <typename Work, typename Combine>
void ordered_reduce(std::size_t count, const Work& work, const Combine& combine) {
  std::size_t started = 0;
  std::size_t finished = 0;
  const auto tokens = 2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  using Result = decltype(work(std::size_t{0}));
  tbb::parallel_pipeline(
      tokens,
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                          [&](tbb::flow_control& control) {
                                            if (started == count) {
                                              control.stop();
                                              return std::size_t{0};
                                            }
                                            return started++;
                                          }) &
          tbb::make_filter<std::size_t, Result>(tbb::filter_mode::parallel,
                                                [&](std::size_t k) { return work(k); }) &
          tbb::make_filter<Result, void>(tbb::filter_mode::serial_in_order, [&](Result result) {
            combine(finished++, std::move(result));
          }));
}

}  // namespace facet_mapping
