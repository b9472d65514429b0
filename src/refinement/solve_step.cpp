// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <tbb/parallel_for.h>

#include "facet_mapping/refinement/step.h"

namespace facet_mapping {
namespace {

/// Summed in one fixed order: the step must not depend on the number of threads.
double dot(const VectorField& a, const VectorField& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum += a[k].dot(b[k]);
  }
  return sum;
}

/// a = scale * a + b.
void scale_and_add(double scale, const VectorField& b, VectorField* a) {
  tbb::parallel_for(
      std::size_t{0}, a->size(), [&](std::size_t k) { (*a)[k] = scale * (*a)[k] + b[k]; });
}

/// a += weight * b.
void add_scaled(double weight, const VectorField& b, VectorField* a) {
  tbb::parallel_for(std::size_t{0}, a->size(), [&](std::size_t k) { (*a)[k] += weight * b[k]; });
}

/// The linear system (H + smoothing) d = -(g + smoothing gradient), restricted to what may move.
class StepSystem {
 public:
  StepSystem(const VertexField& data,
             const SmoothingTerm& smoothing,
             const std::vector<std::uint8_t>& movable)
      : data_(data), smoothing_(smoothing), movable_(movable) {
    diagonal_ = smoothing.hessian_diagonal();
    for (std::size_t k = 0; k < diagonal_.size(); ++k) {
      diagonal_[k] += data.curvature[k];
    }
  }

  VectorField right_side(const VectorField& x) const {
    VectorField result = smoothing_.gradient(x);
    for (std::size_t k = 0; k < result.size(); ++k) {
      result[k] = -(result[k] + data_.gradient[k]);
    }
    restrict(&result);
    return result;
  }

  VectorField times(const VectorField& direction) const {
    VectorField result = smoothing_.hessian_times(direction);
    for (std::size_t k = 0; k < result.size(); ++k) {
      result[k] += data_.curvature[k] * direction[k];
    }
    restrict(&result);
    return result;
  }

  VectorField precondition(const VectorField& residual) const {
    VectorField result(residual.size());
    tbb::parallel_for(std::size_t{0}, residual.size(), [&](std::size_t k) {
      result[k] = residual[k] / diagonal_[k];
    });
    restrict(&result);
    return result;
  }

 private:
  void restrict(VectorField* field) const {
    for (std::size_t k = 0; k < field->size(); ++k) {
      if (movable_[k] == 0 || !(diagonal_[k] > 0.0)) {
        (*field)[k].setZero();
      }
    }
  }

  const VertexField& data_;
  const SmoothingTerm& smoothing_;
  const std::vector<std::uint8_t>& movable_;
  std::vector<double> diagonal_;
};

}  // namespace

VectorField solve_step(const TriangleMesh& mesh,
                       const VertexField& data,
                       const SmoothingTerm& smoothing,
                       const std::vector<std::uint8_t>& movable) {
  constexpr int kMaxIterations = 30;
  constexpr double kTolerance = 1e-3;  // of the residual, relative to the start
  const StepSystem system(data, smoothing, movable);
  VectorField step(mesh.vertices.size(), Eigen::Vector3d::Zero());
  VectorField residual = system.right_side(mesh.vertices);
  VectorField scaled = system.precondition(residual);
  VectorField direction = scaled;
  double power = dot(residual, scaled);
  const double goal = kTolerance * kTolerance * power;
  for (int k = 0; k < kMaxIterations && power > goal; ++k) {
    const VectorField image = system.times(direction);
    const double bend = dot(direction, image);
    if (!(bend > 0.0)) {
      break;
    }
    const double length = power / bend;
    add_scaled(length, direction, &step);
    add_scaled(-length, image, &residual);
    scaled = system.precondition(residual);
    const double next_power = dot(residual, scaled);
    scale_and_add(next_power / power, scaled, &direction);
    power = next_power;
  }
  return step;
}

}  // namespace facet_mapping
