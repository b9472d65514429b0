// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_view.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace facet_mapping {
namespace {

bool is_finite(const geometry_msgs::Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

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
    hide(*key);
    is_changed = true;
  }
  while (const LabeledMeshChunk* chunk = store->take_changed()) {
    show(*chunk, classes);
    is_changed = true;
    if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) {
      break;
    }
  }
  return is_changed;
}

void MeshView::show(const LabeledMeshChunk& chunk, ClassTable* classes) {
  const ChunkKey key{chunk.key[0], chunk.key[1], chunk.key[2]};
  hide(key);
  Shown shown;
  if (!is_finite(chunk.origin)) {
    shown.bad_facets = chunk.triangles.size() / 3;
    shown_[key] = std::move(shown);
    return;
  }
  ChunkGeometry geometry = make_chunk_geometry(chunk, classes);
  add_coarse_levels(&geometry);
  shown.facets = geometry.indices.size() / 3;
  shown.bad_facets = geometry.bad_facets;
  shown.bad_attributes = geometry.bad_attributes;
  shown.area_by_slot_m2 = geometry.area_by_slot_m2;
  if (shown.facets > 0) {
    const Eigen::Vector3d origin(chunk.origin.x, chunk.origin.y, chunk.origin.z);
    shown.box = {origin + geometry.box.min().cast<double>(),
                 origin + geometry.box.max().cast<double>()};
    shown.renderable = std::make_unique<ChunkRenderable>(geometry);
    shown.renderable->setMaterial(material_.material());
    shown.node = parent_->createChildSceneNode();
    shown.node->setPosition(static_cast<float>(origin.x()),
                            static_cast<float>(origin.y()),
                            static_cast<float>(origin.z()));
    shown.node->attachObject(shown.renderable.get());
  }
  facets_ += shown.facets;
  drawn_ += shown.facets;
  shown_[key] = std::move(shown);
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
