// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Facets without a mesh: normals around known directions, with the classes that they belong to.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "labeling/orientation_prior.h"
#include "labeling/votes.h"
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace facet_mapping::test {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

inline Eigen::Vector3d random_unit(std::mt19937* random) {
  std::normal_distribution<double> normal;
  const double x = normal(*random);
  const double y = normal(*random);
  const double z = normal(*random);
  return Eigen::Vector3d(x, y, z).normalized();
}

/// Turned away from `direction`, any way, by an angle with the root mean square `spread_deg`.
inline Eigen::Vector3d near_direction(const Eigen::Vector3d& direction,
                                      double spread_deg,
                                      std::mt19937* random) {
  std::normal_distribution<double> turn(0.0, spread_deg * kDegree / std::sqrt(2.0));
  const Eigen::Vector3d right = direction.unitOrthogonal();
  const Eigen::Vector3d axis = turn(*random) * right + turn(*random) * direction.cross(right);
  return Eigen::AngleAxisd(axis.norm(), axis.normalized()) * direction;
}

/// Normals times areas between 0.5 and 1.5, and their classes.
struct OrientedFacets {
  std::vector<Eigen::Vector3d> normals;
  std::vector<ClassIndex> labels;
  std::mt19937 random{7};

  void add(int count, const Eigen::Vector3d& direction, double spread_deg, ClassIndex label) {
    std::uniform_real_distribution<double> area(0.5, 1.5);
    for (int k = 0; k < count; ++k) {
      const double a = area(random);
      normals.push_back(a * near_direction(direction.normalized(), spread_deg, &random));
      labels.push_back(label);
    }
  }
  /// Every facet on its own, without neighbours.
  FacetGraph graph() const {
    FacetGraph graph;
    graph.edges_of.assign(normals.size(), {-1, -1, -1});
    return graph;
  }
  std::unique_ptr<const OrientationModel> model(const LabelingConfig& config,
                                                std::size_t classes) const {
    const std::vector<ClassIndex> none(labels.size(), kNoClass);
    return make_orientation_model(
        ClassFacets(normals, labels, none, classes, config), graph(), config);
  }
};

inline LabelingConfig with_prior(OrientationPrior prior) {
  LabelingConfig config;
  config.orientation_prior = prior;
  return config;
}

/// Area-weighted mean of what the facets of a class pay for it.
inline double own_cost(const OrientationModel& model,
                       const OrientedFacets& facets,
                       ClassIndex index,
                       const LabelingConfig& config) {
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t f = 0; f < facets.normals.size(); ++f) {
    if (facets.labels[f] == index) {
      const Eigen::Vector3d& normal = facets.normals[f];
      sum += normal.norm() * orientation_cost(model, f, normal, index, config);
      area += normal.norm();
    }
  }
  return sum / area;
}

}  // namespace facet_mapping::test
