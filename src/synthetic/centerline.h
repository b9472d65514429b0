// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Street coordinates: s along the road's middle, t to its left, h above its edge line; metres.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {

/// The cross-section of the street, |t| in metres. The road's middle has h = 0.
namespace cross_section {
constexpr double kRoadHalfWidth = 5.2;
constexpr double kKerbWidth = 0.15;
constexpr double kStripEnd = 6.5;  ///< grass or paving with trees and poles
constexpr double kPavementEnd = 8.7;
constexpr double kBuildingLine = 10.0;  ///< mean facade
constexpr double kBackdrop = 27.0;      ///< trees that close the scene
constexpr double kLane = -1.3;          ///< where the car's left camera drives
constexpr double kParking = 4.15;       ///< middle of a parked car
constexpr double kStripMiddle = 5.85;   ///< where trees and poles stand
}  // namespace cross_section

class Centerline {
 public:
  explicit Centerline(const StreetConfig& config);

  /// Heading of the road, radians to the left of the map's x axis.
  double heading(double s) const;
  Eigen::Vector3d to_map(double s, double t, double h) const;
  /// map_from_local of an object: x along the street, y left, z up, turned left by `yaw`.
  Eigen::Isometry3d frame(double s, double t, double h, double yaw = 0.0) const;

  /// Height of the ground, before bumps, from the road's middle outwards.
  double ground_height(double t) const;

  double begin() const { return begin_; }  ///< where the street's geometry starts
  double end() const { return end_; }      ///< where the road ends

 private:
  Eigen::Vector2d position(double s) const;

  double bend_;
  double wave_number_;
  double crown_;
  double kerb_;
  double origin_height_;
  double begin_;
  double end_;
  std::vector<Eigen::Vector2d> table_;  // positions every kStep from begin_
};

}  // namespace facet_mapping
