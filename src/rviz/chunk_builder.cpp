// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/chunk_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace facet_mapping {
namespace {

constexpr unsigned kMaxThreads = 4;  // more than uploading can follow

constexpr double kFarthestOrigin = 1.0e9;  // metres; farther out single steps get lost

bool is_usable(const geometry_msgs::Point& p) {
  return std::abs(p.x) < kFarthestOrigin && std::abs(p.y) < kFarthestOrigin &&
         std::abs(p.z) < kFarthestOrigin;  // false for NaN
}

BuiltChunk build(const LabeledMeshChunk& chunk, const ClassSlots& slots) {
  BuiltChunk built;
  built.key = key_of(chunk);
  if (!is_usable(chunk.origin)) {
    built.geometry.bad_facets = chunk.triangles.size() / 3;
    return built;
  }
  built.origin = {chunk.origin.x, chunk.origin.y, chunk.origin.z};
  built.geometry = make_chunk_geometry(chunk, slots);
  add_coarse_levels(built.origin, &built.geometry);
  built.packing = VertexPacking(built.origin, built.geometry.box);
  built.vertices.reserve(built.geometry.vertices.size());
  for (const FacetVertex& vertex : built.geometry.vertices) {
    built.vertices.push_back(built.packing.pack(vertex));
  }
  built.geometry.vertices = {};
  return built;
}

}  // namespace

ChunkBuilder::ChunkBuilder() {
  const unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1U, kMaxThreads);
  for (unsigned k = 0; k < threads; ++k) {
    threads_.emplace_back([this] { work(); });
  }
}

ChunkBuilder::~ChunkBuilder() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  is_news_.notify_all();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

void ChunkBuilder::submit(LabeledMeshChunk chunk, ClassSlots slots, std::uint64_t ticket) {
  ++under_way_;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    jobs_.push_back({std::move(chunk), std::move(slots), ticket});
  }
  is_news_.notify_one();
}

std::optional<BuiltChunk> ChunkBuilder::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (built_.empty()) {
    return std::nullopt;
  }
  BuiltChunk built = std::move(built_.front());
  built_.pop_front();
  --under_way_;
  return built;
}

void ChunkBuilder::work() {
  while (true) {
    std::unique_lock<std::mutex> lock(mutex_);
    is_news_.wait(lock, [this] { return is_over_ || !jobs_.empty(); });
    if (is_over_) {
      return;
    }
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    BuiltChunk built = build(job.chunk, job.slots);
    built.ticket = job.ticket;
    lock.lock();
    built_.push_back(std::move(built));
  }
}

}  // namespace facet_mapping
