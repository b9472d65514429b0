// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The smoothness of the surface: umbrella operator and thin plate (Romanoni et al. 2017, Sec. 3.2;
// Vu et al. 2012), in a form that does not shrink thin parts.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping {

using VectorField = std::vector<Eigen::Vector3d>;

/// The umbrella operator U of one tessellation: mean of the neighbours minus the vertex.
class UmbrellaOperator {
 public:
  explicit UmbrellaOperator(const TriangleMesh& mesh);

  /// U x; zero at the border of an open mesh, which smoothing keeps.
  VectorField apply(const VectorField& x) const;

  /// U^T y.
  VectorField apply_transposed(const VectorField& y) const;

  /// The part of the umbrella vectors that the surroundings share: their component along the
  /// normal, averaged over about three rings, times the normal. On a sphere or a pole all vertices
  /// would move inwards by the same amount under the umbrella operator, which tells of the shape's
  /// curvature and not of noise.
  VectorField shared_curvature(const TriangleMesh& mesh) const;

  bool is_border(std::size_t vertex) const { return border_[vertex] != 0; }
  const Adjacency& neighbours() const { return neighbours_; }

 private:
  /// Mean of the inner neighbours' values; 0 at the border.
  std::vector<double> average(const std::vector<double>& values) const;

  Adjacency neighbours_;
  std::vector<std::uint8_t> border_;
};

struct SmoothingConfig {
  double umbrella = 0.2;    ///< weight of the umbrella operator, 0..1
  double thin_plate = 0.2;  ///< weight of the second-order term, 0..1
};

/// The smoothness energy around one shape, quadratic in the positions x:
///   E = 1/2 sum_k w_k (umbrella |x_k - t_k|^2 + thin_plate |(U x)_k - b_k|^2)
/// with the shared curvature b of the start and targets t = start + U start - b. Without b both
/// terms would shrink whatever is curved. The weights w (per square metre) say how much the images
/// would tell about vertex k if its texture were good, so that the parameters are pure numbers:
/// smoothing rules where texture is poor and yields where it is rich.
class SmoothingTerm {
 public:
  SmoothingTerm(const TriangleMesh& start,
                const UmbrellaOperator& umbrella,
                const std::vector<double>& weights,
                const SmoothingConfig& config);

  double energy(const VectorField& x) const;
  VectorField gradient(const VectorField& x) const;
  VectorField hessian_times(const VectorField& direction) const;
  /// Diagonal of the matrix of second derivatives.
  std::vector<double> hessian_diagonal() const;

 private:
  void clear_border(VectorField* field) const;

  const UmbrellaOperator& umbrella_;
  const std::vector<double>& weights_;
  SmoothingConfig config_;
  VectorField curvature_;  // b
  VectorField target_;     // t
};

}  // namespace facet_mapping
