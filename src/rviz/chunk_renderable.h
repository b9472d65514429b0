// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One chunk's buffers on the graphics card.
#pragma once

#include <memory>
#include <vector>

#include <OgreSimpleRenderable.h>

#include "facet_mapping/rviz/chunk_builder.h"

namespace facet_mapping {

/// Hangs below a scene node that stands at packing().center() of the mesh's frame and scales by
/// packing().step_m().
class ChunkRenderable : public Ogre::SimpleRenderable {
 public:
  /// Uploads the chunk, which must have facets.
  explicit ChunkRenderable(const BuiltChunk& chunk);
  ~ChunkRenderable() override;
  ChunkRenderable(const ChunkRenderable&) = delete;
  ChunkRenderable& operator=(const ChunkRenderable&) = delete;
  ChunkRenderable(ChunkRenderable&&) = delete;
  ChunkRenderable& operator=(ChunkRenderable&&) = delete;

  const VertexPacking& packing() const { return packing_; }
  /// The finest level's vertices and indices, as they lie on the graphics card. Slow.
  ChunkGeometry read_back() const;

  /// Chooses the level whose loss cannot be seen from there.
  void _notifyCurrentCamera(Ogre::Camera* camera) override;
  Ogre::Real getBoundingRadius() const override { return radius_; }
  Ogre::Real getSquaredViewDepth(const Ogre::Camera* camera) const override;

 private:
  void upload_vertices(const std::vector<PackedVertex>& vertices);
  struct Level {
    float cell_m = 0.0F;
    std::unique_ptr<Ogre::IndexData> indices;
  };

  void add_level(const std::vector<std::uint32_t>& indices, float cell_m, bool is_short);
  float pixels_per_metre(const Ogre::Camera& camera) const;

  VertexPacking packing_;
  std::vector<Level> levels_;  // from fine to coarse
  Ogre::Real radius_ = 0.0F;
};

}  // namespace facet_mapping
