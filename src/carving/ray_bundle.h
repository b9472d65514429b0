// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Many ray walks by turns. In a large triangulation a walk mostly waits for memory: while one
// waits, the others go on.
#pragma once

#include <array>
#include <cstddef>

#include "carving/ray_walk.h"

namespace facet_mapping::carving {

/// Walks the rays 0 .. count - 1 and calls `visit(k, walk)` at each cell of ray k, where `walk` is
/// a `const RayWalk&` that stands in that cell. Each ray's cells come in its order, exactly those
/// of a RayWalk of its own; different rays take turns. `start(k)` gives the vertex, `target(k)` the
/// point; both may be asked more than once. `finish(k, walk)` is called once for each ray, after
/// its last cell.
template <typename Start, typename Target, typename Visit, typename Finish>
void walk_rays(const Triangulation& triangulation,
               std::size_t count,
               const Start& start,
               const Target& target,
               const Visit& visit,
               const Finish& finish) {
  constexpr std::size_t kWalks = 32;  // beyond what a core can have in flight to memory
  struct Slot {
    RayWalk walk;
    std::size_t ray = 0;
    bool is_cell_here = false;
  };
  std::array<Slot, kWalks> slots;
  std::size_t next_ray = 0;
  std::size_t open = 0;
  const auto refill = [&](Slot& slot) {
    if (next_ray + kWalks < count) {
      __builtin_prefetch(&*start(next_ray + kWalks));
    }
    while (slot.walk.done() && next_ray < count) {
      slot.ray = next_ray++;
      slot.walk = RayWalk::turning_walk(triangulation, start(slot.ray), target(slot.ray));
      if (slot.walk.done()) {
        finish(slot.ray, static_cast<const RayWalk&>(slot.walk));
      }
    }
    open += slot.walk.done() ? 0 : 1;
  };
  const auto arrive = [&](Slot& slot) {
    slot.walk.fetch_next_cell();
    slot.is_cell_here = false;
    if (!slot.walk.turning()) {
      visit(slot.ray, static_cast<const RayWalk&>(slot.walk));
    }
  };
  const auto turn = [&](Slot& slot) {
    if (!slot.is_cell_here) {
      slot.walk.fetch_next_corner();
      slot.is_cell_here = true;
      return;
    }
    slot.walk.advance();
    if (slot.walk.done()) {
      finish(slot.ray, static_cast<const RayWalk&>(slot.walk));
      --open;
      refill(slot);
    }
    if (!slot.walk.done()) {
      arrive(slot);
    }
  };
  for (Slot& slot : slots) {
    refill(slot);
    if (!slot.walk.done()) {
      arrive(slot);
    }
  }
  while (open > 0) {  // NOLINT(bugprone-infinite-loop): turn() lowers it
    for (Slot& slot : slots) {
      if (!slot.walk.done()) {
        turn(slot);
      }
    }
  }
}

template <typename Start, typename Target, typename Visit>
void walk_rays(const Triangulation& triangulation,
               std::size_t count,
               const Start& start,
               const Target& target,
               const Visit& visit) {
  walk_rays(triangulation, count, start, target, visit, [](std::size_t, const RayWalk&) {});
}

}  // namespace facet_mapping::carving
