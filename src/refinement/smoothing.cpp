// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/smoothing.h"

#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

std::vector<std::uint8_t> find_border(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> border(mesh.vertices.size(), 0);
  const std::vector<FacetNeighbours> neighbours = facet_neighbours(mesh);
  for (std::size_t f = 0; f < neighbours.size(); ++f) {
    for (int side = 0; side < 3; ++side) {
      if (neighbours[f][side] < 0) {
        border[mesh.triangles[f][side]] = 1;
        border[mesh.triangles[f][(side + 1) % 3]] = 1;
      }
    }
  }
  return border;
}

}  // namespace

UmbrellaOperator::UmbrellaOperator(const TriangleMesh& mesh)
    : neighbours_(vertex_neighbours(mesh)), border_(find_border(mesh)) {}

VectorField UmbrellaOperator::apply(const VectorField& x) const {
  VectorField result(x.size(), Eigen::Vector3d::Zero());
  tbb::parallel_for(std::size_t{0}, x.size(), [&](std::size_t k) {
    const std::size_t count = neighbours_.size(k);
    if (border_[k] != 0 || count == 0) {
      return;
    }
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t* l = neighbours_.begin(k); l != neighbours_.end(k); ++l) {
      sum += x[*l];
    }
    result[k] = sum / static_cast<double>(count) - x[k];
  });
  return result;
}

VectorField UmbrellaOperator::apply_transposed(const VectorField& y) const {
  VectorField result(y.size(), Eigen::Vector3d::Zero());
  tbb::parallel_for(std::size_t{0}, y.size(), [&](std::size_t k) {
    if (neighbours_.size(k) == 0) {
      return;
    }
    if (border_[k] == 0) {
      result[k] = -y[k];
    }
    for (const std::uint32_t* l = neighbours_.begin(k); l != neighbours_.end(k); ++l) {
      if (border_[*l] == 0) {
        result[k] += y[*l] / static_cast<double>(neighbours_.size(*l));
      }
    }
  });
  return result;
}

std::vector<double> UmbrellaOperator::average(const std::vector<double>& values) const {
  std::vector<double> result(values.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t k) {
    double sum = 0.0;
    int count = 0;
    for (const std::uint32_t* l = neighbours_.begin(k); l != neighbours_.end(k); ++l) {
      if (border_[*l] == 0) {
        sum += values[*l];
        ++count;
      }
    }
    result[k] = count > 0 && border_[k] == 0 ? sum / count : 0.0;
  });
  return result;
}

VectorField UmbrellaOperator::shared_curvature(const TriangleMesh& mesh) const {
  constexpr int kRings = 3;
  VectorField result = apply(mesh.vertices);
  const VectorField normals = vertex_normals(mesh);
  std::vector<double> along(result.size());
  for (std::size_t k = 0; k < along.size(); ++k) {
    along[k] = result[k].dot(normals[k]);
  }
  for (int ring = 0; ring < kRings; ++ring) {
    along = average(along);
  }
  for (std::size_t k = 0; k < along.size(); ++k) {
    result[k] = along[k] * normals[k];
  }
  return result;
}

SmoothingTerm::SmoothingTerm(const TriangleMesh& start,
                             const UmbrellaOperator& umbrella,
                             const std::vector<double>& weights,
                             const SmoothingConfig& config)
    : umbrella_(umbrella),
      weights_(weights),
      config_(config),
      curvature_(umbrella.shared_curvature(start)),
      target_(umbrella.apply(start.vertices)) {
  for (std::size_t k = 0; k < target_.size(); ++k) {
    target_[k] += start.vertices[k] - curvature_[k];
  }
}

void SmoothingTerm::clear_border(VectorField* field) const {
  for (std::size_t k = 0; k < field->size(); ++k) {
    if (umbrella_.is_border(k)) {
      (*field)[k].setZero();
    }
  }
}

double SmoothingTerm::energy(const VectorField& x) const {
  const VectorField bending = umbrella_.apply(x);
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!umbrella_.is_border(k)) {
      sum += weights_[k] * (config_.umbrella * (x[k] - target_[k]).squaredNorm() +
                            config_.thin_plate * (bending[k] - curvature_[k]).squaredNorm());
    }
  }
  return 0.5 * sum;
}

VectorField SmoothingTerm::gradient(const VectorField& x) const {
  VectorField bending = umbrella_.apply(x);
  for (std::size_t k = 0; k < x.size(); ++k) {
    bending[k] = weights_[k] * config_.thin_plate * (bending[k] - curvature_[k]);
  }
  VectorField result = umbrella_.apply_transposed(bending);
  for (std::size_t k = 0; k < x.size(); ++k) {
    result[k] += weights_[k] * config_.umbrella * (x[k] - target_[k]);
  }
  clear_border(&result);
  return result;
}

VectorField SmoothingTerm::hessian_times(const VectorField& direction) const {
  VectorField inner = direction;
  clear_border(&inner);
  VectorField bending = umbrella_.apply(inner);
  for (std::size_t k = 0; k < bending.size(); ++k) {
    bending[k] *= weights_[k] * config_.thin_plate;
  }
  VectorField result = umbrella_.apply_transposed(bending);
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k] += weights_[k] * config_.umbrella * inner[k];
  }
  clear_border(&result);
  return result;
}

std::vector<double> SmoothingTerm::hessian_diagonal() const {
  const Adjacency& neighbours = umbrella_.neighbours();
  std::vector<double> diagonal(weights_.size(), 0.0);
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    if (umbrella_.is_border(k)) {
      continue;
    }
    double bending = weights_[k];
    for (const std::uint32_t* l = neighbours.begin(k); l != neighbours.end(k); ++l) {
      const auto count = static_cast<double>(neighbours.size(*l));
      bending += umbrella_.is_border(*l) ? 0.0 : weights_[*l] / (count * count);
    }
    diagonal[k] = weights_[k] * config_.umbrella + config_.thin_plate * bending;
  }
  return diagonal;
}

}  // namespace facet_mapping
