// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The scene's dominant planes, learnt from depths.
#pragma once

#include <deque>
#include <vector>

#include "sweep_image.h"
#include "sweep_planes.h"

namespace facet_mapping::detail {

/// A direction of planes and where they are, as seen from one camera.
struct PlaneDirection {
  Eigen::Vector3d normal;  // camera frame, away from the camera
  InverseRange distances;
};

/// Small pieces of surface of the last images vote for their normals.
class SceneDirections {
 public:
  /// Adds the pieces of a swept image.
  void add(const SweepImage& image);
  void clear() { images_.clear(); }
  bool empty() const { return images_.empty(); }

  /// The normals with most votes, most first, and the distances of the pieces that voted; none that
  /// nearly faces the camera, whose planes are swept anyway.
  std::vector<PlaneDirection> strongest(const View& view, int most) const;

  struct Piece {
    Eigen::Vector3d normal;  // world, away from the camera
    Eigen::Vector3d center;  // world
  };

 private:
  std::deque<std::vector<Piece>> images_;
};

}  // namespace facet_mapping::detail
