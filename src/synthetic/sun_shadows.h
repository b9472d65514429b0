// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which points of the street the sun reaches: shadow maps on square tiles of the ground plan.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {

class SunShadows {
 public:
  explicit SunShadows(const Street& street);

  /// 0 (shadow) to 1 (sun) at a surface point; outside all tiles 1.
  float sunlit(const Eigen::Vector3d& point, const Eigen::Vector3f& normal) const;

 private:
  using Key = std::pair<int, int>;
  struct Tile {
    PinholeCamera camera;
    Eigen::Isometry3d sun_from_map;
    cv::Mat depth;  // metres from the sun's camera, 0 = nothing
  };

  static Key key_at(const Eigen::Vector3d& point);
  static Tile make_tile(const Street& street, const Key& key);

  std::map<Key, std::size_t> index_;
  std::vector<Tile> tiles_;
};

}  // namespace facet_mapping
