// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How chunks are drawn: the shaders, their settings, the palette texture.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <OgreMaterial.h>
#include <OgreTexture.h>

#include "facet_mapping/rviz/class_table.h"

namespace facet_mapping {

/// The numbers stand in the shader.
enum class ColorMode {
  kClass = 0,
  kConfidence = 1,
  kNormal = 2,
  kHeight = 3,
  kViews = 4,
  kChunk = 5,
  kFlat = 6,
};

enum class MeshStyle { kFaces, kWireframe, kBoth };

/// Lengths in metres, heights along z of the fixed frame.
struct MeshLook {
  ColorMode mode = ColorMode::kClass;
  MeshStyle style = MeshStyle::kFaces;
  bool lighting = true;
  bool cull_back_faces = false;
  float alpha = 1.0F;
  float min_confidence = 0.0F;  ///< 0..1
  bool unseen_facets = false;   ///< draw facets that no ray has met (views 0), too
  float max_distance = 0.0F;    ///< from the eye; 0: no limit
  bool cut = false;             ///< true: nothing above cut_height is drawn
  float cut_height = 0.0F;
  std::array<float, 2> height_range{{0.0F, 1.0F}};
  float full_views = 20.0F;  ///< number of views at the upper end of the ramp
  Rgb flat_color{{200, 200, 200}};
};

class MeshMaterial {
 public:
  MeshMaterial();
  ~MeshMaterial();
  MeshMaterial(const MeshMaterial&) = delete;
  MeshMaterial& operator=(const MeshMaterial&) = delete;
  MeshMaterial(MeshMaterial&&) = delete;
  MeshMaterial& operator=(MeshMaterial&&) = delete;

  const Ogre::MaterialPtr& material() const { return material_; }
  /// Touches no geometry. `is_translucent`: of a class.
  void set_look(const MeshLook& look, bool is_translucent);
  /// Rewrites the texture from ClassTable::texels().
  void set_palette(const std::vector<std::uint8_t>& texels);

 private:
  void add_pass(const char* fragment_program, Ogre::Technique* technique);
  void make_texture();

  std::string name_;  // unique
  Ogre::MaterialPtr material_;
  Ogre::TexturePtr texture_;
};

}  // namespace facet_mapping
