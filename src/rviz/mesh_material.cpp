// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_material.h"

#include <utility>

#include "mesh_shaders.h"
#include "ogre_helpers.h"
#include <OgreGpuProgramParams.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreHighLevelGpuProgram.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>

namespace facet_mapping {
namespace {

std::string unique_name() {
  static int count = 0;
  return "facet_mapping/LabeledMesh" + std::to_string(count++);
}

constexpr const char* kVertexProgram = "facet_mapping/mesh_vertex";
constexpr const char* kFragmentProgram = "facet_mapping/mesh_fragment";
constexpr const char* kDepthProgram = "facet_mapping/mesh_depth";
constexpr const char* kPickProgram = "facet_mapping/mesh_pick";
constexpr float kOpaque = 0.998F;
constexpr float kEdgeDarkening = 0.35F;  // of edges drawn over faces

void make_program(const char* name, Ogre::GpuProgramType type, const char* source) {
  auto& manager = Ogre::HighLevelGpuProgramManager::getSingleton();
  if (!manager.getByName(name, resource_group())) {
    manager.createProgram(name, resource_group(), "glsl", type)->setSource(source);
  }
}

void set_common(const MeshLook& look, bool is_blended, Ogre::Pass* pass) {
  pass->setCullingMode(look.cull_back_faces ? Ogre::CULL_CLOCKWISE : Ogre::CULL_NONE);
  pass->setSceneBlending(is_blended ? Ogre::SBT_TRANSPARENT_ALPHA : Ogre::SBT_REPLACE);
  pass->setDepthWriteEnabled(!is_blended);
}

constexpr float kNoLimit = 1.0e9F;

void set_vertex_uniforms(const MeshLook& look,
                         float darkening,
                         Ogre::GpuProgramParameters* params) {
  params->setNamedConstant("mode", static_cast<float>(look.mode));
  params->setNamedConstant("alpha", look.alpha);
  params->setNamedConstant("lighting", look.lighting ? 1.0F : 0.0F);
  params->setNamedConstant("darkening", darkening);
  params->setNamedConstant("min_confidence", 255.0F * look.min_confidence);
  params->setNamedConstant("min_views", look.unseen_facets ? 0.0F : 1.0F);
  params->setNamedConstant("full_views", look.full_views);
  params->setNamedConstant("flat_rgb",
                           Ogre::Vector4(static_cast<float>(look.flat_color[0]) / 255.0F,
                                         static_cast<float>(look.flat_color[1]) / 255.0F,
                                         static_cast<float>(look.flat_color[2]) / 255.0F,
                                         1.0F));
}

void set_fragment_uniforms(const MeshLook& look, Ogre::GpuProgramParameters* params) {
  params->setNamedConstant("mode", static_cast<float>(look.mode));
  params->setNamedConstant("max_distance", look.max_distance > 0.0F ? look.max_distance : kNoLimit);
  params->setNamedConstant("cut_height", look.cut ? look.cut_height : kNoLimit);
  params->setNamedConstant("height_range",
                           Ogre::Vector2(look.height_range[0], look.height_range[1]));
}

}  // namespace

MeshMaterial::MeshMaterial() : name_(unique_name()) {
  make_program(kVertexProgram, Ogre::GPT_VERTEX_PROGRAM, kMeshVertexShader);
  make_program(kFragmentProgram, Ogre::GPT_FRAGMENT_PROGRAM, kMeshFragmentShader);
  make_program(kDepthProgram, Ogre::GPT_FRAGMENT_PROGRAM, kMeshDepthShader);
  make_program(kPickProgram, Ogre::GPT_FRAGMENT_PROGRAM, kMeshPickShader);
  make_texture();
  material_ = Ogre::MaterialManager::getSingleton().create(name_, resource_group());
  material_->setReceiveShadows(false);
  material_->removeAllTechniques();
  add_pass(kFragmentProgram, material_->createTechnique());
  // rviz's tools draw the scene by schemes of their own; what they put in the place of a material
  // that lacks these knows nothing of packed vertices and hidden classes.
  for (const auto& [scheme, program] :
       {std::pair("Depth", kDepthProgram), {"Pick", kPickProgram}, {"Pick1", kPickProgram}}) {
    Ogre::Technique* technique = material_->createTechnique();
    technique->setSchemeName(scheme);
    add_pass(program, technique);
  }
  set_look(MeshLook(), false);
}

MeshMaterial::~MeshMaterial() {
  Ogre::MaterialManager::getSingleton().remove(material_->getHandle());
  Ogre::TextureManager::getSingleton().remove(texture_->getHandle());
}

void MeshMaterial::make_texture() {
  texture_ = Ogre::TextureManager::getSingleton().createManual(name_ + "/palette",
                                                               resource_group(),
                                                               Ogre::TEX_TYPE_2D,
                                                               ClassTable::kSlots,
                                                               ClassTable::kRows,
                                                               0,
                                                               Ogre::PF_BYTE_RGBA,
                                                               Ogre::TU_DYNAMIC_WRITE_ONLY);
  set_palette(ClassTable().texels());
}

void MeshMaterial::add_pass(const char* fragment_program, Ogre::Technique* technique) {
  Ogre::Pass* pass = technique->createPass();
  pass->setLightingEnabled(false);
  pass->setVertexProgram(kVertexProgram);
  pass->setFragmentProgram(fragment_program);
  const Ogre::GpuProgramParametersSharedPtr vertex = pass->getVertexProgramParameters();
  vertex->setIgnoreMissingParams(true);
  vertex->setNamedConstant("palette", 0);
  vertex->setNamedAutoConstant("to_screen", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
  vertex->setNamedAutoConstant("to_view", Ogre::GpuProgramParameters::ACT_WORLDVIEW_MATRIX);
  vertex->setNamedAutoConstant("to_world", Ogre::GpuProgramParameters::ACT_WORLD_MATRIX);
  const Ogre::GpuProgramParametersSharedPtr fragment = pass->getFragmentProgramParameters();
  fragment->setIgnoreMissingParams(true);
  fragment->setNamedConstant("palette", 0);
  fragment->setNamedAutoConstant("far_clip", Ogre::GpuProgramParameters::ACT_FAR_CLIP_DISTANCE);
  Ogre::TextureUnitState* unit = pass->createTextureUnitState();
  unit->setTexture(texture_);
  unit->setTextureFiltering(Ogre::TFO_NONE);
  unit->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
}

void MeshMaterial::set_look(const MeshLook& look, bool is_translucent) {
  const bool is_blended = is_translucent || look.alpha < kOpaque;
  Ogre::Technique* technique = material_->getTechnique(0);
  // Ogre has no switch for a pass: the second is there only while both faces and edges are drawn.
  while (technique->getNumPasses() > (look.style == MeshStyle::kBoth ? 2U : 1U)) {
    technique->removePass(1);
  }
  if (look.style == MeshStyle::kBoth && technique->getNumPasses() < 2) {
    add_pass(kFragmentProgram, technique);
  }
  for (unsigned short k = 0; k < technique->getNumPasses(); ++k) {
    Ogre::Pass* pass = technique->getPass(k);
    const bool has_edges = k == 1 || look.style == MeshStyle::kWireframe;
    pass->setPolygonMode(has_edges ? Ogre::PM_WIREFRAME : Ogre::PM_SOLID);
    pass->setDepthBias(k == 1 ? 2.0F : 0.0F, k == 1 ? 2.0F : 0.0F);
    set_common(look, is_blended, pass);
    set_vertex_uniforms(
        look, k == 1 ? kEdgeDarkening : 1.0F, pass->getVertexProgramParameters().get());
    set_fragment_uniforms(look, pass->getFragmentProgramParameters().get());
  }
  for (unsigned short k = 1; k < material_->getNumTechniques(); ++k) {
    Ogre::Pass* pass = material_->getTechnique(k)->getPass(0);
    set_common(look, false, pass);
    set_vertex_uniforms(look, 1.0F, pass->getVertexProgramParameters().get());
    set_fragment_uniforms(look, pass->getFragmentProgramParameters().get());
  }
}

void MeshMaterial::set_palette(const std::vector<std::uint8_t>& texels) {
  std::vector<std::uint8_t> copy = texels;  // a PixelBox takes no constant data
  const Ogre::PixelBox box(
      ClassTable::kSlots, ClassTable::kRows, 1, Ogre::PF_BYTE_RGBA, copy.data());
  texture_->getBuffer()->blitFromMemory(box);
}

}  // namespace facet_mapping
