// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <OgreQuaternion.h>
#include <OgreResourceGroupManager.h>
#include <OgreVector.h>

namespace facet_mapping {

inline Ogre::Vector3 to_ogre(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

inline Ogre::Quaternion to_ogre(const Eigen::Quaterniond& q) {
  return {static_cast<float>(q.w()),
          static_cast<float>(q.x()),
          static_cast<float>(q.y()),
          static_cast<float>(q.z())};
}

/// Where our materials and textures lie: Debian's rviz aborts on some in the group "rviz".
inline const Ogre::String& resource_group() {
  return Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME;
}

}  // namespace facet_mapping
