// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Texture coordinates and normals at points of facets.
#pragma once

#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {

struct SurfaceSample {
  Eigen::Vector3f texture;
  Eigen::Vector3f normal;  ///< unit, as the mesh is oriented
  const Material* material;
};

/// Remembers the last facet: cheapest where neighbours follow each other. One per thread.
class SurfaceSampler {
 public:
  explicit SurfaceSampler(const Street& street) : street_(street) {}

  SurfaceSample at(std::int32_t facet, const Eigen::Vector3d& point);
  /// Unit normal of the facet of the last sample.
  const Eigen::Vector3f& facet_normal() const { return facet_normal_; }

 private:
  void load(std::int32_t facet);

  const Street& street_;
  std::int32_t facet_ = -1;
  Eigen::Vector3d corner_;
  Eigen::Vector3f facet_normal_;
  Eigen::Vector3f to_second_;  // dot with (point - corner): barycentric coordinate of corner 1
  Eigen::Vector3f to_third_;
  Eigen::Matrix3f texture_;  // columns: at corner 0, steps to corners 1 and 2
  Eigen::Matrix3f normal_;
};

}  // namespace facet_mapping
