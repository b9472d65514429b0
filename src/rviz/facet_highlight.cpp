// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_highlight.h"

#include <string>

#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>

namespace facet_mapping {
namespace {

constexpr double kNormalLength = 0.06;  // of the distance from the eye: seen as well from afar
const Ogre::ColourValue kFill(1.0F, 1.0F, 0.0F, 0.6F);
const Ogre::ColourValue kLine(1.0F, 1.0F, 1.0F, 1.0F);

// Debian's rviz aborts on materials in the group "rviz".
const Ogre::String& group() {
  return Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME;
}

Ogre::MaterialPtr make_material() {
  static int count = 0;
  Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      "facet_mapping/FacetHighlight" + std::to_string(count++), group());
  material->setReceiveShadows(false);
  Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
  pass->setLightingEnabled(false);
  pass->setCullingMode(Ogre::CULL_NONE);
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  pass->setDepthCheckEnabled(false);
  pass->setDepthWriteEnabled(false);
  return material;
}

Ogre::Vector3 to_ogre(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

FacetHighlight::FacetHighlight(Ogre::SceneManager* scene)
    : scene_(scene),
      node_(scene->getRootSceneNode()->createChildSceneNode()),
      object_(scene->createManualObject()),
      material_(make_material()) {
  object_->setDynamic(true);
  object_->setRenderQueueGroup(Ogre::RENDER_QUEUE_9);  // after meshes, translucent ones included
  node_->attachObject(object_);
}

FacetHighlight::~FacetHighlight() {
  node_->detachAllObjects();
  scene_->destroyManualObject(object_);
  scene_->destroySceneNode(node_);
  Ogre::MaterialManager::getSingleton().remove(material_->getHandle());
}

void FacetHighlight::show(const FacetInfo& facet) {
  hide();
  node_->setPosition(to_ogre(facet.at));  // what follows is near it, and so exact
  const auto add = [&](const Eigen::Vector3d& place, const Ogre::ColourValue& color) {
    object_->position(to_ogre(place - facet.at));
    object_->colour(color);
  };
  object_->begin(material_->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, group());
  for (const Eigen::Vector3d& corner : facet.corners) {
    add(corner, kFill);
  }
  object_->end();
  object_->begin(material_->getName(), Ogre::RenderOperation::OT_LINE_LIST, group());
  for (std::size_t k = 0; k < 3; ++k) {
    add(facet.corners[k], kLine);
    add(facet.corners[(k + 1) % 3], kLine);
  }
  add(facet.at, kLine);
  add(facet.at + kNormalLength * facet.distance * facet.normal, kLine);
  object_->end();
}

void FacetHighlight::hide() {
  object_->clear();
}

}  // namespace facet_mapping
