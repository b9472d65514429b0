// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_sampler.h"

namespace facet_mapping {
namespace {

Eigen::Matrix3f steps(const std::vector<Eigen::Vector3f>& values, const Triangle& t) {
  Eigen::Matrix3f columns;
  columns << values[t[0]], values[t[1]] - values[t[0]], values[t[2]] - values[t[0]];
  return columns;
}

}  // namespace

void SurfaceSampler::load(std::int32_t facet) {
  facet_ = facet;
  const Triangle& t = street_.mesh.triangles[static_cast<std::size_t>(facet)];
  corner_ = street_.mesh.vertices[t[0]];
  const Eigen::Vector3d second = street_.mesh.vertices[t[1]] - corner_;
  const Eigen::Vector3d third = street_.mesh.vertices[t[2]] - corner_;
  const Eigen::Vector3d cross = second.cross(third);
  const double squared = cross.squaredNorm();
  to_second_ = (third.cross(cross) / squared).cast<float>();
  to_third_ = (cross.cross(second) / squared).cast<float>();
  facet_normal_ = cross.normalized().cast<float>();
  texture_ = steps(street_.texture, t);
  normal_ = steps(street_.normals, t);
}

SurfaceSample SurfaceSampler::at(std::int32_t facet, const Eigen::Vector3d& point) {
  if (facet != facet_) {
    load(facet);
  }
  const Eigen::Vector3f offset = (point - corner_).cast<float>();
  const Eigen::Vector3f weights(1.0F, to_second_.dot(offset), to_third_.dot(offset));
  const auto index = street_.material[static_cast<std::size_t>(facet)];
  return {texture_ * weights, (normal_ * weights).normalized(), &street_.materials[index]};
}

}  // namespace facet_mapping
