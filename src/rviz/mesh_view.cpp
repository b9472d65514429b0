// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_view.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "ogre_helpers.h"

namespace facet_mapping {
namespace {

constexpr std::size_t kMaxUnderWay = 64;  // bounds the memory of chunks that are ready

}  // namespace

MeshView::MeshView(Ogre::SceneNode* parent) : parent_(parent) {}

MeshView::~MeshView() {
  while (!shown_.empty()) {
    hide(ChunkKey(shown_.begin()->first));
  }
}

bool MeshView::update(ChunkStore* store, ClassTable* classes, double seconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  bool is_changed = false;
  while (const std::optional<ChunkKey> key = store->take_removed()) {
    newest_.erase(*key);
    hide(*key);
    is_changed = true;
  }
  submit_changed(store, classes);
  while (std::chrono::duration<double>(Clock::now() - start).count() < seconds) {
    const std::optional<BuiltChunk> built = builder_.take();
    if (!built) {
      break;
    }
    const auto newest = newest_.find(built->key);
    if (newest != newest_.end() && newest->second == built->ticket) {
      newest_.erase(newest);
      show(*built);
      is_changed = true;
    }
    submit_changed(store, classes);
  }
  return is_changed;
}

void MeshView::submit_changed(ChunkStore* store, ClassTable* classes) {
  while (builder_.under_way() < kMaxUnderWay) {
    std::optional<LabeledMeshChunk> chunk = store->take_changed();
    if (!chunk) {
      return;
    }
    newest_[key_of(*chunk)] = ++tickets_;
    ClassSlots slots = classes->slots_of(chunk->labels);
    builder_.submit(std::move(*chunk), std::move(slots), tickets_);
  }
}

void MeshView::show(const BuiltChunk& chunk) {
  hide(chunk.key);
  const ChunkGeometry& geometry = chunk.geometry;
  Shown shown;
  shown.facets = geometry.indices.size() / 3;
  shown.bad_facets = geometry.bad_facets;
  shown.bad_attributes = geometry.bad_attributes;
  shown.has_confidence = geometry.has_confidence;
  shown.has_views = geometry.has_views;
  shown.area_by_slot_m2 = geometry.area_by_slot_m2;
  if (shown.facets > 0) {
    shown.origin = chunk.origin;
    shown.box = {chunk.origin + geometry.box.min().cast<double>(),
                 chunk.origin + geometry.box.max().cast<double>()};
    shown.renderable = std::make_unique<ChunkRenderable>(chunk);
    shown.renderable->setMaterial(material_.material());
    shown.node = parent_->createChildSceneNode();
    const VertexPacking& packing = shown.renderable->packing();
    shown.node->setPosition(to_ogre(packing.center()));
    shown.node->setScale(Ogre::Vector3(static_cast<float>(packing.step_m())));
    shown.node->attachObject(shown.renderable.get());
  }
  facets_ += shown.facets;
  drawn_ += shown.facets;
  shown_[chunk.key] = std::move(shown);
}

void MeshView::hide(const ChunkKey& key) {
  const auto found = shown_.find(key);
  if (found == shown_.end()) {
    return;
  }
  facets_ -= found->second.facets;
  if (found->second.node != nullptr) {
    found->second.node->detachAllObjects();
    parent_->getCreator()->destroySceneNode(found->second.node);
  }
  shown_.erase(found);
}

std::optional<MeshView::Picked> MeshView::pick(const PickRay& ray, const PickFilter& filter) const {
  std::vector<std::pair<double, ChunkKey>> met;  // by where the ray enters the chunk's box
  for (const auto& [key, shown] : shown_) {
    const std::optional<double> entry =
        shown.renderable ? entry_distance(ray, shown.box) : std::nullopt;
    if (entry) {
      met.emplace_back(*entry, key);
    }
  }
  std::sort(met.begin(), met.end());
  std::optional<Picked> best;
  for (const auto& [entry, key] : met) {
    if (best && best->hit.distance < entry) {
      break;
    }
    const Shown& shown = shown_.at(key);
    const ChunkGeometry geometry = shown.renderable->read_back();
    std::optional<FacetHit> hit =
        nearest_facet(ray, filter, shown.origin, geometry.vertices, geometry.indices);
    if (hit && (!best || hit->distance < best->hit.distance)) {
      best = Picked{key, *hit, shown.has_confidence, shown.has_views};
    }
  }
  return best;
}

std::size_t MeshView::bad_facets() const {
  std::size_t count = 0;
  for (const auto& [key, shown] : shown_) {
    count += shown.bad_facets;
  }
  return count;
}

std::size_t MeshView::chunks_with_bad_attributes() const {
  std::size_t count = 0;
  for (const auto& [key, shown] : shown_) {
    count += shown.bad_attributes ? 1 : 0;
  }
  return count;
}

std::vector<double> MeshView::area_by_slot_m2() const {
  std::vector<double> areas(ClassTable::kSlots, 0.0);
  for (const auto& [key, shown] : shown_) {
    for (const auto& [slot, area] : shown.area_by_slot_m2) {
      areas[slot] += area;
    }
  }
  return areas;
}

Eigen::AlignedBox3d MeshView::box() const {
  Eigen::AlignedBox3d box;
  for (const auto& [key, shown] : shown_) {
    box.extend(shown.box);  // an empty box adds nothing
  }
  return box;
}

Eigen::AlignedBox3d MeshView::box_in_view(const Ogre::Camera& camera) const {
  Eigen::AlignedBox3d box;
  for (const auto& [key, shown] : shown_) {
    if (shown.node != nullptr && camera.isVisible(shown.node->_getWorldAABB())) {
      box.extend(shown.box);
    }
  }
  return box;
}

}  // namespace facet_mapping
