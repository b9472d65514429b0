// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/local_orientation.h"

#include <algorithm>

#include "labeling/global_orientation.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

// Neighbourhoods are this many times larger than the patches that share them.
constexpr int kPatchesAround = 16;

std::size_t patch_size(const LabelingConfig& config) {
  return static_cast<std::size_t>(std::max(config.local_facets / kPatchesAround, 1));
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
              : fit_orientation(facets.normals(), own[k], least_sigma_rad(config));
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
