// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The chunks on the screen.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "chunk_renderable.h"
#include "mesh_material.h"
#include <Eigen/Geometry>
#include <OgreCamera.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include "facet_mapping/rviz/chunk_store.h"
#include "facet_mapping/rviz/class_table.h"

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

  /// Takes away what is gone and draws changed chunks anew until the time is over, at least one.
  /// True if anything changed.
  bool update(ChunkStore* store, ClassTable* classes, double seconds);

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
    Eigen::AlignedBox3d box;
    std::map<std::uint8_t, double> area_by_slot_m2;
    std::size_t facets = 0;
    std::size_t bad_facets = 0;
    bool bad_attributes = false;
  };

  void show(const LabeledMeshChunk& chunk, ClassTable* classes);
  void hide(const ChunkKey& key);

  Ogre::SceneNode* parent_;
  MeshMaterial material_;
  std::map<ChunkKey, Shown> shown_;
  std::size_t facets_ = 0;
  std::size_t drawn_ = 0;
};

}  // namespace facet_mapping
