// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/refined_map.h"

#include <utility>

namespace facet_mapping {

using Lock = std::lock_guard<std::mutex>;

RefinedMap::RefinedMap(std::function<MeshStatePtr()> map,
                       MeshPublisher* refined,
                       NodeDiagnostics* diagnostics,
                       std::function<void()> on_publish)
    : map_(std::move(map)),
      refined_(refined),
      diagnostics_(diagnostics),
      on_publish_(std::move(on_publish)),
      jobs_(1, [this](const std::string& error) {
        diagnostics_->complain("refined parts not merged",
                               "laying what was refined over the new map: " + error);
      }) {}

RefineStart RefinedMap::from_map() const {
  const MeshStatePtr map = map_();
  return {map, map};
}

RefineStart RefinedMap::from_refined() const {
  const Lock lock(mutex_);
  return {refined_->current(), base_};
}

MeshStatePtr RefinedMap::newest() const {
  const RefineStart refined = from_refined();
  if (refined.mesh && refined.map) {
    return refined.mesh;
  }
  const MeshStatePtr map = map_();
  const bool use_map = !refined.mesh || (map && map->stamp > refined.mesh->stamp);
  return use_map ? map : refined.mesh;
}

void RefinedMap::take(const RefineStart& start, TriangleMesh result, const MeshPart& part) {
  {
    const Lock lock(mutex_);
    if (start.map) {
      const bool has_all = start.mesh != start.map;  // it went on from what was refined before
      overlay_.add(start.map->mesh, std::move(result), has_all ? MeshPart{} : part);
      publish_merged_locked();
    } else {
      overlay_.clear();
      base_.reset();
      publish_locked(std::move(result), start.mesh->stamp);
    }
  }
  on_publish_();
}

void RefinedMap::on_map_update() {
  jobs_.post([this] { merge_again(); });  // a full queue means that the newest is still to come
}

bool RefinedMap::rest() {
  std::unique_lock<std::mutex> lock(rest_mutex_);
  wake_.wait_until(lock, next_merge_, [this] { return stopping_; });
  return !stopping_;
}

void RefinedMap::merge_again() {
  constexpr int kRest = 3;  // of the time that a merge takes
  if (!rest()) {
    return;
  }
  const auto begin = std::chrono::steady_clock::now();
  {
    const Lock lock(mutex_);
    if (overlay_.empty()) {
      return;
    }
    publish_merged_locked();
  }
  on_publish_();
  const auto end = std::chrono::steady_clock::now();
  next_merge_ = end + kRest * (end - begin);
}

void RefinedMap::stop() {
  {
    const Lock lock(rest_mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  jobs_.stop();
}

void RefinedMap::publish_merged_locked() {
  MeshStatePtr map = map_();
  if (!map) {
    return;
  }
  if (map->mesh.empty()) {  // the mapper was reset
    overlay_.clear();
  }
  publish_locked(overlay_.merge(map->mesh), map->stamp);
  base_ = std::move(map);
  constexpr double kMib = 1024.0 * 1024.0;
  diagnostics_->set("refined parts kept [MiB]", static_cast<double>(overlay_.bytes()) / kMib);
}

void RefinedMap::publish_locked(TriangleMesh mesh, const ros::Time& stamp) {
  auto state = std::make_shared<MeshState>();
  state->mesh = std::move(mesh);
  state->vertex_ids = ids_.number(state->mesh.vertices);
  state->stamp = stamp;
  refined_->publish(std::move(state));
}

void RefinedMap::clear(const ros::Time& stamp) {
  const Lock lock(mutex_);
  overlay_.clear();
  base_.reset();
  refined_->reset(stamp);
}

}  // namespace facet_mapping
