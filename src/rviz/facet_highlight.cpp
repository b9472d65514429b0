// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_highlight.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "ogre_helpers.h"
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>

namespace facet_mapping {
namespace {

// The normal is as well seen from afar, yet not longer than the facet warrants.
constexpr double kNormalOfDistance = 0.06;
constexpr double kNormalOfFacet = 5.0;  // times the square root of its area
const Ogre::ColourValue kFill(1.0F, 1.0F, 0.0F, 0.6F);
const Ogre::ColourValue kLine(1.0F, 1.0F, 1.0F, 1.0F);

Ogre::MaterialPtr make_material() {
  static int count = 0;
  Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      "facet_mapping/FacetHighlight" + std::to_string(count++), resource_group());
  material->setReceiveShadows(false);
  Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
  pass->setLightingEnabled(false);
  pass->setCullingMode(Ogre::CULL_NONE);
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  pass->setDepthCheckEnabled(false);
  pass->setDepthWriteEnabled(false);
  return material;
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
  position_ = facet.position;
  const auto add = [&](const Eigen::Vector3d& place, const Ogre::ColourValue& color) {
    object_->position(to_ogre(place - facet.position));  // near it, and so exact
    object_->colour(color);
  };
  object_->begin(material_->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, resource_group());
  for (const Eigen::Vector3d& corner : facet.corners) {
    add(corner, kFill);
  }
  object_->end();
  object_->begin(material_->getName(), Ogre::RenderOperation::OT_LINE_LIST, resource_group());
  for (std::size_t k = 0; k < 3; ++k) {
    add(facet.corners[k], kLine);
    add(facet.corners[(k + 1) % 3], kLine);
  }
  const double length =
      std::min(kNormalOfDistance * facet.distance, kNormalOfFacet * std::sqrt(facet.area_m2));
  add(facet.position, kLine);
  add(facet.position + length * cross_of(facet).normalized(), kLine);
  object_->end();
}

void FacetHighlight::place(const Eigen::Isometry3d& fixed_from_mesh) {
  node_->setPosition(to_ogre(Eigen::Vector3d(fixed_from_mesh * position_)));
  node_->setOrientation(to_ogre(Eigen::Quaterniond(fixed_from_mesh.linear())));
}

void FacetHighlight::hide() {
  object_->clear();
}

}  // namespace facet_mapping
