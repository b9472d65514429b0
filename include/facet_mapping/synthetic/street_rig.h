// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The car's sensors: a rectified stereo pair and a LiDAR, laid out like KITTI's.
#pragma once

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {

struct StreetRig {
  PinholeCamera camera;     ///< of both pictures
  double baseline_m = 0.0;  ///< the right camera stands this much along +x of the left one
  Eigen::Isometry3d left_from_velo = Eigen::Isometry3d::Identity();  ///< velo: x forward, z up

  Eigen::Isometry3d right_from_left() const;
  View left_view(const Eigen::Isometry3d& map_from_left) const;
  View right_view(const Eigen::Isometry3d& map_from_left) const;
};

/// KITTI's colour pair: 1242 x 375 pixels if `full_size`, else 621 x 188.
StreetRig kitti_rig(bool full_size);

}  // namespace facet_mapping
