// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A synthetic street: a class-labelled triangle mesh of road, pavements, buildings, parked cars,
// poles, signs, trees and hedges with procedural textures, and the drive of a car along it.
//
// Map frame (REP-103): x forward, y left, z up, metres; the origin is the first left camera.
// Classes are Cityscapes train ids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/synthetic/material.h"

namespace facet_mapping {

/// The street's classes. Sky is the background, no facet carries it.
namespace street_class {
constexpr Label kRoad = 0;
constexpr Label kSidewalk = 1;
constexpr Label kBuilding = 2;
constexpr Label kPole = 5;
constexpr Label kTrafficSign = 7;
constexpr Label kVegetation = 8;
constexpr Label kTerrain = 9;
constexpr Label kSky = 10;
constexpr Label kCar = 13;
}  // namespace street_class

struct StreetConfig {
  double length_m = 60.0;         ///< along the street, first camera to the road's end; 20 .. 5000
  std::uint64_t seed = 1;         ///< everything random follows from it
  double bend_rad = 0.0;          ///< largest heading of the S-curve; 0 = straight, at most 0.5
  double bend_period_m = 240.0;   ///< length of one S; at least 100
  double crown_m = 0.10;          ///< the road's middle lies this much above its edges
  double kerb_height_m = 0.12;    ///< pavement above the road's edge
  double car_density = 0.5;       ///< share of parking places that are taken, 0 .. 1
  double tree_spacing_m = 10.0;   ///< mean distance between trees of one side; at least 4
  double gap_share = 0.5;         ///< share of buildings with a gap behind them, 0 .. 1
  double camera_height_m = 1.65;  ///< first left camera above the road under it
  int frames = 0;                 ///< frames of the drive; 0 = as many as fit the length
  double frame_spacing_m = 1.1;   ///< between frames
  double frame_rate_hz = 10.0;    ///< for the time stamps
  double pose_jitter = 1.0;       ///< scales sway (cm) and pitch, roll (tenths of a degree)
};

/// One instant of the drive. `map_from_left`: the left camera's optical frame (z forward, y down).
struct StreetPose {
  double stamp = 0.0;  ///< seconds
  Eigen::Isometry3d map_from_left = Eigen::Isometry3d::Identity();
};

/// A run of facets that belong together (a car, ten metres of road); no vertex is shared with
/// another part. Parts are what rendering culls.
struct StreetPart {
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  std::uint32_t first_facet = 0;
  std::uint32_t facet_count = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of a bounding sphere, map frame
  double radius = 0.0;                               ///< of the bounding sphere, metres
};

struct Street {
  StreetConfig config;
  TriangleMesh mesh;                                  ///< map frame, every facet labelled
  std::vector<StreetPose> trajectory;                 ///< the first pose is the map's origin, level
  std::vector<StreetPart> parts;                      ///< covers all facets, in order
  std::vector<Material> materials;                    ///< what the facets look like
  std::vector<std::uint16_t> material;                ///< per facet: index into `materials`
  std::vector<Eigen::Vector3f> texture;               ///< per vertex: texture coordinates, metres
  std::vector<Eigen::Vector3f> normals;               ///< per vertex: unit, smooth within a surface
  Eigen::Vector3d to_sun = Eigen::Vector3d::UnitZ();  ///< unit, map frame
};

/// The distance that the drive keeps to the road's end, so that its last frame still sees a street.
constexpr double kStreetEndMargin = 14.0;

/// Builds the street. Same configuration, same street, to the last bit. Throws
/// std::invalid_argument with all problems of the configuration at once.
Street make_street(const StreetConfig& config);

}  // namespace facet_mapping
