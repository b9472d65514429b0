// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/class_orientation.h"

#include <algorithm>
#include <cmath>

namespace facet_mapping {
namespace {

// Below this length of the mean unit normal its direction is noise.
constexpr double kLeastResultant = 1e-3;

}  // namespace

bool is_directed(const Eigen::Vector3d& sum, double area) {
  return sum.norm() > kLeastResultant * area;
}

double angle_between(const Eigen::Vector3d& unit, const Eigen::Vector3d& normal) {
  return std::acos(std::clamp(unit.dot(normal) / normal.norm(), -1.0, 1.0));
}

ClassOrientation fit_orientation(const std::vector<Eigen::Vector3d>& normals,
                                 const FacetList& facets,
                                 double least_sigma_rad) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const std::uint32_t f : facets) {
    sum += normals[f];
    area += normals[f].norm();
  }
  ClassOrientation orientation;
  if (!is_directed(sum, area)) {
    return orientation;
  }
  orientation.mean = sum.normalized();
  double squares = 0.0;
  for (const std::uint32_t f : facets) {
    const double angle = angle_between(orientation.mean, normals[f]);
    squares += normals[f].norm() * angle * angle;
  }
  orientation.sigma_rad = std::max(std::sqrt(squares / area), least_sigma_rad);
  return orientation;
}

double deviation_cost(const ClassOrientation& orientation, const Eigen::Vector3d& normal) {
  if (orientation.mean.isZero(0.0)) {
    return kMeanOrientationCost;
  }
  const double deviation = angle_between(orientation.mean, normal) / orientation.sigma_rad;
  return 0.5 * deviation * deviation;
}

}  // namespace facet_mapping
