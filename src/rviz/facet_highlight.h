// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The marked facet in the 3D view.
#pragma once

#include <Eigen/Geometry>
#include <OgreManualObject.h>
#include <OgreMaterial.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include "facet_mapping/rviz/facet_info.h"

namespace facet_mapping {

/// Drawn over everything: a filled triangle with its edges, and its normal.
class FacetHighlight {
 public:
  explicit FacetHighlight(Ogre::SceneManager* scene);
  ~FacetHighlight();
  FacetHighlight(const FacetHighlight&) = delete;
  FacetHighlight& operator=(const FacetHighlight&) = delete;
  FacetHighlight(FacetHighlight&&) = delete;
  FacetHighlight& operator=(FacetHighlight&&) = delete;

  /// place() says where.
  void show(const FacetInfo& facet);
  void place(const Eigen::Isometry3d& fixed_from_mesh);
  void hide();

 private:
  Ogre::SceneManager* scene_;
  Ogre::SceneNode* node_;
  Ogre::ManualObject* object_;
  Ogre::MaterialPtr material_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();  // of the facet, in the mesh's frame
};

}  // namespace facet_mapping
