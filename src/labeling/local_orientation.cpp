// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/local_orientation.h"

#include <algorithm>
#include <cmath>

#include "labeling/global_orientation.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

// Neighbourhoods are this many times larger than the patches that share them.
constexpr int kPatchesAround = 16;

// A patch of wrong labels would otherwise find its own orientation quite usual.
constexpr double kGlobalShare = 0.25;

std::size_t patch_size(const LabelingConfig& config) {
  return static_cast<std::size_t>(std::max(config.local_facets / kPatchesAround, 1));
}

/// The local orientation, held back by the global one as if that were `more` facets more.
ClassOrientation held_back(const ClassOrientation& local,
                           const ClassOrientation& global,
                           double facets,
                           double more) {
  if (local.mean.isZero(0.0) || global.mean.isZero(0.0)) {
    return local;
  }
  const double own = facets / (facets + more);
  const Eigen::Vector3d sum = own * local.mean + (1.0 - own) * global.mean;
  if (!is_directed(sum, 1.0)) {
    return local;
  }
  const auto square = [&](const ClassOrientation& part) {
    const double turn = angle_between(sum.normalized(), part.mean);
    return part.sigma_rad * part.sigma_rad + turn * turn;
  };
  return {sum.normalized(), std::sqrt(own * square(local) + (1.0 - own) * square(global))};
}

}  // namespace

LocalOrientation::LocalOrientation(const ClassFacets& facets,
                                   const FacetGraph& graph,
                                   const LabelingConfig& config)
    : patches_(make_patches(graph, patch_size(config))), scale_(facets.all().size(), 1.0) {
  const std::vector<ClassOrientation> global = GlobalOrientation(facets, config).orientations();
  const auto least = static_cast<std::size_t>(std::max(config.min_normal_facets, 1));
  orientations_.resize(patches_.facets.size() * global.size());
  tbb::parallel_for(std::size_t{0}, patches_.facets.size(), [&](std::size_t p) {
    const std::vector<FacetList> own = facets.among(facets_around(
        patches_, static_cast<std::uint32_t>(p), static_cast<std::size_t>(config.local_facets)));
    for (std::size_t k = 0; k < own.size(); ++k) {
      orientations_[p * own.size() + k] =
          own[k].size() < least
              ? global[k]
              : held_back(fit_orientation(facets.normals(), own[k], least_sigma_rad(config)),
                          global[k],
                          static_cast<double>(own[k].size()),
                          kGlobalShare * config.local_facets);
    }
  });
  normalise(facets);
}

void LocalOrientation::normalise(const ClassFacets& facets) {
  for (std::size_t k = 0; k < scale_.size(); ++k) {
    double area = 0.0;
    double sum = 0.0;
    for (const std::uint32_t f : facets.all()[k]) {
      const Eigen::Vector3d& normal = facets.normals()[f];
      area += normal.norm();
      sum += normal.norm() * deviation_cost(around(f, k), normal);
    }
    // Less is what the least deviation gives a flat class, as in the global form.
    scale_[k] = sum > kMeanOrientationCost * area ? kMeanOrientationCost * area / sum : 1.0;
  }
}

double LocalOrientation::cost(std::size_t facet,
                              const Eigen::Vector3d& normal,
                              std::size_t index) const {
  return scale_[index] * deviation_cost(around(facet, index), normal);
}

}  // namespace facet_mapping
