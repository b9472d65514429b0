// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One chunk's buffers on the graphics card.
#pragma once

#include <OgreSimpleRenderable.h>

#include "facet_mapping/rviz/chunk_geometry.h"

namespace facet_mapping {

/// Hangs below a scene node at the chunk's origin.
class ChunkRenderable : public Ogre::SimpleRenderable {
 public:
  /// Uploads the geometry, which must not be empty.
  explicit ChunkRenderable(const ChunkGeometry& geometry);
  ~ChunkRenderable() override;
  ChunkRenderable(const ChunkRenderable&) = delete;
  ChunkRenderable& operator=(const ChunkRenderable&) = delete;
  ChunkRenderable(ChunkRenderable&&) = delete;
  ChunkRenderable& operator=(ChunkRenderable&&) = delete;

  Ogre::Real getBoundingRadius() const override { return radius_; }
  Ogre::Real getSquaredViewDepth(const Ogre::Camera* camera) const override;

 private:
  void upload_vertices(const ChunkGeometry& geometry);
  void upload_indices(const ChunkGeometry& geometry);

  Ogre::Real radius_ = 0.0F;
};

}  // namespace facet_mapping
