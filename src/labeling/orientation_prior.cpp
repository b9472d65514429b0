// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/orientation_prior.h"

#include <algorithm>
#include <cmath>

#include "labeling/votes.h"

namespace facet_mapping {
namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

// Below this length of the mean unit normal its direction is noise.
constexpr double kLeastResultant = 1e-3;

double angle_between(const Eigen::Vector3d& unit, const Eigen::Vector3d& normal) {
  return std::acos(std::clamp(unit.dot(normal) / normal.norm(), -1.0, 1.0));
}

struct Sums {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double area = 0.0;
  double squared_angle = 0.0;
  int facets = 0;
};

/// Adds only up those classes that are not done yet.
void estimate(const std::vector<Eigen::Vector3d>& normals,
              const std::vector<ClassIndex>& labels,
              const LabelingConfig& config,
              std::vector<ClassOrientation>* orientations) {
  std::vector<Sums> sums(orientations->size());
  const auto for_each_facet = [&](const auto& visit) {
    for (std::size_t f = 0; f < labels.size(); ++f) {
      const double area = normals[f].norm();
      if (labels[f] != kNoClass && area > 0.0 && (*orientations)[labels[f]].sigma_rad == 0.0) {
        visit(normals[f], area, &sums[labels[f]], labels[f]);
      }
    }
  };
  for_each_facet([](const Eigen::Vector3d& normal, double area, Sums* s, ClassIndex) {
    s->normal += normal;
    s->area += area;
    ++s->facets;
  });
  for_each_facet([](const Eigen::Vector3d& normal, double area, Sums* s, ClassIndex) {
    const double angle = s->normal.isZero() ? 0.0 : angle_between(s->normal.normalized(), normal);
    s->squared_angle += area * angle * angle;
  });
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (sums[k].facets >= std::max(config.min_normal_facets, 1)) {
      const bool directed = sums[k].normal.norm() > kLeastResultant * sums[k].area;
      (*orientations)[k].mean = directed ? sums[k].normal.normalized() : Eigen::Vector3d::Zero();
      (*orientations)[k].sigma_rad = std::max(std::sqrt(sums[k].squared_angle / sums[k].area),
                                              config.min_normal_sigma_deg * kRadiansPerDegree);
    }
  }
}

}  // namespace

std::vector<ClassOrientation> estimate_orientations(const std::vector<Eigen::Vector3d>& normals,
                                                    const std::vector<ClassIndex>& labels,
                                                    const std::vector<ClassIndex>& fallback,
                                                    std::size_t classes,
                                                    const LabelingConfig& config) {
  std::vector<ClassOrientation> orientations(classes);
  estimate(normals, labels, config, &orientations);
  estimate(normals, fallback, config, &orientations);
  return orientations;
}

double orientation_cost(const ClassOrientation& orientation,
                        const Eigen::Vector3d& normal,
                        const LabelingConfig& config) {
  if (normal.isZero(0.0)) {
    return 0.0;
  }
  // What a class pays on average at its own facets; for free, unknown classes would win everywhere.
  double cost = 0.5;
  if (!orientation.mean.isZero()) {
    const double deviation = angle_between(orientation.mean, normal) / orientation.sigma_rad;
    cost = 0.5 * deviation * deviation;
  }
  return std::min(cost, -std::log(config.normal_floor));
}

}  // namespace facet_mapping
