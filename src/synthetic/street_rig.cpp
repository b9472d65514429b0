// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_rig.h"

namespace facet_mapping {

Eigen::Isometry3d StreetRig::right_from_left() const {
  return Eigen::Isometry3d(Eigen::Translation3d(-baseline_m, 0.0, 0.0));
}

View StreetRig::left_view(const Eigen::Isometry3d& map_from_left) const {
  return {camera, map_from_left};
}

View StreetRig::right_view(const Eigen::Isometry3d& map_from_left) const {
  return {camera, map_from_left * right_from_left().inverse()};
}

StreetRig kitti_rig(bool full_size) {
  StreetRig rig;
  rig.camera = {1242, 375, 721.5377, 721.5377, 609.5593, 172.854};
  if (!full_size) {
    // Exactly half, so that pixels stay square; the last row reaches half a pixel further down.
    rig.camera = {621,
                  188,
                  0.5 * 721.5377,
                  0.5 * 721.5377,
                  0.5 * (609.5593 + 0.5) - 0.5,
                  0.5 * (172.854 + 0.5) - 0.5};
  }
  rig.baseline_m = 0.54325;
  rig.left_from_velo.linear() << 0, -1, 0,  //
      0, 0, -1,                             //
      1, 0, 0;
  rig.left_from_velo.translation() = Eigen::Vector3d(0.06, -0.08, -0.27);
  return rig;
}

}  // namespace facet_mapping
