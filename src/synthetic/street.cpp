// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street.h"

#include <algorithm>
#include <cmath>

#include "centerline.h"
#include "random.h"
#include "scene_parts.h"
#include "street_check.h"
#include "trajectory.h"

namespace facet_mapping {
namespace {

using namespace cross_section;

constexpr double kPi = 3.14159265358979323846;
constexpr double kEndFacade = 5.0;  // metres from the road's end to the buildings that close it
constexpr double kKeepFree = 0.6;   // metres between the trees and poles of a row

/// Streams of random numbers, so that one kind of thing does not change with another's number.
enum Stream : std::uint64_t { kMaterials, kGround, kBuildings, kCars, kTrees, kPoles, kHedges };

std::vector<BuildingPlan> plan_buildings(const StreetConfig& config,
                                         const Centerline& line,
                                         Random* random) {
  std::vector<BuildingPlan> plans;
  for (const int side : {1, -1}) {
    double s = line.begin() + random->uniform(0.0, 4.0);
    while (s < line.end() - 7.0) {
      BuildingPlan plan;
      plan.side = side;
      plan.begin = s;
      plan.end = std::min(s + random->uniform(9.0, 15.0), line.end() + 2.0);
      plan.front = kBuildingLine + random->uniform(-0.5, 1.2);
      plan.depth = random->uniform(7.5, 9.5);
      plans.push_back(plan);
      s = plan.end + (random->chance(config.gap_share) ? random->uniform(2.5, 6.0) : 0.02);
    }
  }
  return plans;
}

void add_buildings(const Scene& scene, const std::vector<BuildingPlan>& plans, Random* random) {
  for (const BuildingPlan& plan : plans) {
    // On the right the facade's x axis runs against the street.
    const double corner = plan.side > 0 ? -0.5 * plan.width() : 0.5 * plan.width();
    const double height = scene.line->ground_height(plan.front);
    Eigen::Isometry3d frame =
        scene.line->frame(0.5 * (plan.begin + plan.end), plan.side * plan.front, height);
    frame.translate(Eigen::Vector3d(corner, 0.0, 0.0));
    frame.rotate(Eigen::AngleAxisd(plan.side > 0 ? 0.0 : kPi, Eigen::Vector3d::UnitZ()));
    add_building(scene, frame, plan.width(), plan.depth, random);
  }
}

/// The buildings across the road's end.
void add_closing_buildings(const Scene& scene, Random* random) {
  double t = kBackdrop;
  while (t > -kBackdrop + 7.0) {
    const double width = std::min(random->uniform(10.0, 15.0), t + kBackdrop);
    const double distance = kEndFacade + random->uniform(0.0, 1.5);
    const Eigen::Isometry3d frame = scene.line->frame(
        scene.line->end() + distance, t, scene.line->ground_height(kBuildingLine), -0.5 * kPi);
    add_building(scene, frame, width, 8.0, random);
    t -= width + (random->chance(0.4) ? 2.0 : 0.02);
  }
}

void add_cars(const Scene& scene, double density, Random* random) {
  for (const int side : {1, -1}) {
    double s = 8.0 + random->uniform(0.0, 3.0);
    while (s < scene.line->end() - 3.0) {
      if (random->chance(density)) {
        const double t = side * (kParking + random->uniform(-0.12, 0.12));
        const double yaw = (side > 0 ? kPi : 0.0) + random->uniform(-0.03, 0.03);
        add_car(scene, scene.line->frame(s, t, scene.line->ground_height(t), yaw), random);
      }
      s += random->uniform(5.4, 6.4);
    }
  }
}

Eigen::Isometry3d strip_place(const Scene& scene, double s, int side) {
  const double t = side * kStripMiddle;
  return scene.line->frame(s, t, scene.line->ground_height(t));
}

void add_trees_and_poles(const Scene& scene, double spacing, Random* trees, Random* poles) {
  for (const int side : {1, -1}) {
    double s = trees->uniform(3.0, 3.0 + spacing);
    while (s < scene.line->end() - 2.0) {
      add_tree(scene, strip_place(scene, s, side), trees);
      const double next = s + spacing * trees->uniform(0.7, 1.3);
      const double between = poles->uniform(s + kKeepFree, next - kKeepFree);
      if (between < scene.line->end() - 2.0 && poles->chance(0.75)) {
        const Eigen::Isometry3d place = strip_place(scene, between, side);
        if (poles->chance(0.6)) {
          add_sign_pole(scene, place, poles);
        } else {
          Eigen::Isometry3d lamp = place;
          lamp.rotate(Eigen::AngleAxisd(side > 0 ? kPi : 0.0, Eigen::Vector3d::UnitZ()));
          add_lamp_pole(scene, lamp);
        }
      }
      s = next;
    }
  }
}

/// Hedges between the pavement and some facades, in pieces that follow the street.
void add_hedges(const Scene& scene, const std::vector<BuildingPlan>& plans, Random* random) {
  for (const BuildingPlan& plan : plans) {
    if (!random->chance(0.45) || plan.front < 9.8) {
      continue;
    }
    const double t = plan.side * (kPavementEnd + 0.5);
    const double begin = std::max(plan.begin, scene.line->begin()) + 0.5;
    const double end = std::min(plan.end, scene.line->end() - 1.0) - random->uniform(0.5, 4.0);
    if (end - begin > 2.0) {
      add_hedge(
          scene, scene.line->frame(begin, t, scene.line->ground_height(t)), end - begin, random);
    }
  }
}

void fill(Street* street) {
  const StreetConfig& config = street->config;
  const auto stream = [&](Stream name) { return Random(derive_seed(config.seed, name)); };
  SceneBuilder builder(street);
  const Centerline line(config);
  Random random = stream(kMaterials);
  const Scene scene{&builder, &line, add_shared_materials(&builder, &random)};
  random = stream(kBuildings);
  const std::vector<BuildingPlan> plans = plan_buildings(config, line, &random);
  add_buildings(scene, plans, &random);
  add_closing_buildings(scene, &random);
  random = stream(kGround);
  add_ground(scene, plans, &random);
  add_backdrop(scene, random.bits32());
  random = stream(kCars);
  add_cars(scene, config.car_density, &random);
  random = stream(kTrees);
  Random poles = stream(kPoles);
  add_trees_and_poles(scene, config.tree_spacing_m, &random, &poles);
  random = stream(kHedges);
  add_hedges(scene, plans, &random);
  builder.finish();
}

}  // namespace

Street make_street(const StreetConfig& config) {
  check(config);
  Street street;
  street.config = config;
  street.to_sun = Eigen::Vector3d(-0.55, 0.62, 0.95).normalized();
  fill(&street);
  street.trajectory = drive(config, Centerline(config));
  return street;
}

}  // namespace facet_mapping
