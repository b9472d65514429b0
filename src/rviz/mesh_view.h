// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The chunks on the screen.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "chunk_renderable.h"
#include "mesh_material.h"
#include <Eigen/Geometry>
#include <OgreCamera.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include "facet_mapping/rviz/chunk_builder.h"
#include "facet_mapping/rviz/chunk_store.h"
#include "facet_mapping/rviz/class_table.h"
#include "facet_mapping/rviz/facet_pick.h"

namespace facet_mapping {

class MeshView {
 public:
  /// Hangs below `parent`, whose axes are those of the mesh.
  explicit MeshView(Ogre::SceneNode* parent);
  ~MeshView();
  MeshView(const MeshView&) = delete;
  MeshView& operator=(const MeshView&) = delete;
  MeshView(MeshView&&) = delete;
  MeshView& operator=(MeshView&&) = delete;

  /// Takes away what is gone, has changed chunks made anew and uploads those that are ready until
  /// the time is over. True if anything changed on the screen.
  bool update(ChunkStore* store, ClassTable* classes, double seconds);
  /// Taken from the store, but not yet on the screen.
  std::size_t waiting() const { return builder_.under_way(); }

  struct Picked {
    ChunkKey chunk{};
    FacetHit hit;
    bool has_confidence = false;
    bool has_views = false;
  };
  /// The first facet on the ray, which is in the mesh's frame.
  std::optional<Picked> pick(const PickRay& ray, const PickFilter& filter) const;

  MeshMaterial& material() { return material_; }
  std::size_t facets() const { return facets_; }
  /// Facets drawn anew since the beginning.
  std::size_t drawn() const { return drawn_; }
  std::size_t bad_facets() const;
  std::size_t chunks_with_bad_attributes() const;
  std::vector<double> area_by_slot_m2() const;
  /// In the mesh's own frame.
  Eigen::AlignedBox3d box() const;
  /// Of the chunks that the camera sees, in the mesh's own frame.
  Eigen::AlignedBox3d box_in_view(const Ogre::Camera& camera) const;

 private:
  struct Shown {
    Ogre::SceneNode* node = nullptr;
    std::unique_ptr<ChunkRenderable> renderable;  // null if nothing could be drawn
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::AlignedBox3d box;
    bool has_confidence = false;
    bool has_views = false;
    std::map<std::uint8_t, double> area_by_slot_m2;
    std::size_t facets = 0;
    std::size_t bad_facets = 0;
    bool bad_attributes = false;
  };

  void submit_changed(ChunkStore* store, ClassTable* classes);
  void show(const BuiltChunk& chunk);
  void hide(const ChunkKey& key);

  Ogre::SceneNode* parent_;
  MeshMaterial material_;
  std::map<ChunkKey, Shown> shown_;
  ChunkBuilder builder_;
  std::map<ChunkKey, std::uint64_t> newest_;  // ticket of those under way, unless gone meanwhile
  std::uint64_t tickets_ = 0;
  std::size_t facets_ = 0;
  std::size_t drawn_ = 0;
};

}  // namespace facet_mapping
