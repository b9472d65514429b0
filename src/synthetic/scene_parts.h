// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in the street. Each function adds one or more parts.
#pragma once

#include <vector>

#include "centerline.h"
#include "random.h"
#include "scene_builder.h"

namespace facet_mapping {

/// A building's place: facade from `begin` to `end` along the street, `front` metres from its
/// middle, on the left (side = 1) or on the right (-1).
struct BuildingPlan {
  double begin = 0.0;
  double end = 0.0;
  double front = 0.0;
  double depth = 0.0;
  int side = 1;

  double width() const { return end - begin; }
};

/// Materials that many parts share.
struct SharedMaterials {
  std::uint16_t asphalt = 0;
  std::uint16_t kerb = 0;
  std::uint16_t paving = 0;
  std::uint16_t grass = 0;
  std::uint16_t bark = 0;
  std::uint16_t metal = 0;
  std::uint16_t wheel = 0;
  std::uint16_t backdrop = 0;
};
SharedMaterials add_shared_materials(SceneBuilder* builder, Random* random);

struct Scene {
  SceneBuilder* builder;
  const Centerline* line;
  SharedMaterials shared;
};

/// Road, kerbs, pavements and terrain, and the kerb and terrain that end the road. No terrain is
/// laid under the buildings.
void add_ground(const Scene& scene, const std::vector<BuildingPlan>& buildings, Random* random);

/// The rows of trees behind the buildings.
void add_backdrop(const Scene& scene, std::uint32_t seed);

/// Local frame: x along the facade, y into the building, z up; the corner of the facade at the
/// ground is the origin.
void add_building(const Scene& scene,
                  const Eigen::Isometry3d& map_from_local,
                  double width,
                  double depth,
                  Random* random);

/// Local frame of everything below: x forward, y left, z up, on the ground.
void add_car(const Scene& scene, const Eigen::Isometry3d& map_from_local, Random* random);
void add_tree(const Scene& scene, const Eigen::Isometry3d& map_from_local, Random* random);
/// `length` along x from the origin.
void add_hedge(const Scene& scene,
               const Eigen::Isometry3d& map_from_local,
               double length,
               Random* random);
/// A pole of 0.1 m radius with a sign that faces -x.
void add_sign_pole(const Scene& scene, const Eigen::Isometry3d& map_from_local, Random* random);
/// A lamp whose arm reaches along y.
void add_lamp_pole(const Scene& scene, const Eigen::Isometry3d& map_from_local);

}  // namespace facet_mapping
