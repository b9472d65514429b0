// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the display that answers for single facets.
#include <cmath>

#include "labeled_mesh_display.h"

namespace facet_mapping {
namespace {

PickFilter filter_of(const MeshLook& look,
                     const ClassTable& classes,
                     const Eigen::Isometry3d& fixed_from_mesh) {
  PickFilter filter;
  for (const ClassStyle& style : classes.styles()) {
    filter.shown.push_back(style.visible && style.alpha > 0.0F);
  }
  filter.min_confidence = static_cast<std::uint8_t>(std::ceil(255.0F * look.min_confidence));
  filter.min_views = look.unseen_facets ? 0 : 1;
  filter.cull_back_faces = look.cull_back_faces;
  if (look.max_distance > 0.0F) {
    filter.max_distance = static_cast<double>(look.max_distance);
  }
  if (look.cut) {
    filter.up = fixed_from_mesh.linear().transpose() * Eigen::Vector3d::UnitZ();
    filter.max_height = static_cast<double>(look.cut_height) - fixed_from_mesh.translation().z();
  }
  return filter;
}

FacetInfo info_of(const MeshView::Picked& picked,
                  const ClassTable& classes,
                  const Eigen::Isometry3d& fixed_from_mesh) {
  const FacetHit& hit = picked.hit;
  FacetInfo facet;
  const ClassStyle& style = classes.styles()[hit.attributes[0]];
  facet.class_name = style.name;
  facet.class_id = style.id;
  if (picked.has_confidence) {
    facet.confidence = hit.attributes[1] / 255.0;
  }
  if (picked.has_views) {
    facet.views = hit.attributes[2];
  }
  facet.chunk = picked.chunk;
  facet.distance = hit.distance;
  facet.corners = hit.corners;
  const Eigen::Vector3d cross = fixed_from_mesh.linear() * cross_of(facet);
  facet.area_m2 = 0.5 * cross.norm();
  facet.normal = facet.area_m2 > 0.0 ? Eigen::Vector3d(cross.normalized()) : cross;
  return facet;
}

}  // namespace

Eigen::Isometry3d LabeledMeshDisplay::fixed_from_mesh() const {
  const Ogre::Vector3& p = scene_node_->getPosition();
  const Ogre::Quaternion& q = scene_node_->getOrientation();
  return Eigen::Translation3d(p.x, p.y, p.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

std::optional<FacetInfo> LabeledMeshDisplay::inspect(const PickRay& ray,
                                                     const Eigen::Vector3d& eye) const {
  if (!view_ || alpha_->getFloat() <= 0.0F) {
    return std::nullopt;
  }
  const Eigen::Isometry3d transform = fixed_from_mesh();
  const PickRay in_mesh(transform.inverse() * ray.origin(),
                        transform.linear().transpose() * ray.direction());
  PickFilter filter = filter_of(look(), classes_, transform);
  filter.eye = transform.inverse() * eye;
  const std::optional<MeshView::Picked> picked = view_->pick(in_mesh, filter);
  if (!picked) {
    return std::nullopt;
  }
  FacetInfo facet = info_of(*picked, classes_, transform);
  facet.frame_id = store_.frame_id();
  facet.position = in_mesh.pointAt(facet.distance);
  return facet;
}

}  // namespace facet_mapping
