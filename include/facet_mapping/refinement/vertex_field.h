// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What an energy says about each vertex.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace facet_mapping {

/// First and second order of an energy in the vertex positions.
struct VertexField {
  std::vector<Eigen::Vector3d> gradient;  ///< d energy / d position, per metre
  /// Diagonal bound of the Gauss-Newton matrix, per square metre: gradient / curvature is a step in
  /// metres whatever the number of pixels, the image size and the unit of length.
  std::vector<double> curvature;

  VertexField() = default;
  explicit VertexField(std::size_t vertices)
      : gradient(vertices, Eigen::Vector3d::Zero()), curvature(vertices, 0.0) {}

  void add(std::size_t vertex, const Eigen::Vector3d& g, double h) {
    gradient[vertex] += g;
    curvature[vertex] += h;
  }

  /// this += weight * other.
  void add(const VertexField& other, double weight = 1.0);

  void clear();
};

}  // namespace facet_mapping
