// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A sensor that moves along a wall.
#pragma once

#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping::test {

/// A wall of class 1, 6 m in front of a sensor at `x`: a grid of points `spacing_m` apart, `half`
/// of them to each side of the middle one, above and below it.
inline PointFrame wall_seen_from(double x, int half, float spacing_m) {
  PointFrame frame;
  frame.stamp = 100.0 + x;
  frame.world_from_sensor.translation().x() = x;
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      LabeledPoint point;
      // A little depth, so that the triangulation is in general position.
      point.position = {spacing_m * static_cast<float>(i),
                        spacing_m * static_cast<float>(j),
                        6.0F + 0.01F * static_cast<float>((i * 7 + j * 3) % 5)};
      point.label = 1;
      frame.points.push_back(point);
    }
  }
  return frame;
}

}  // namespace facet_mapping::test
