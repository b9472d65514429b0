// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The facets that the orientation prior learns from.
#pragma once

#include <cstdint>
#include <vector>

#include "labeling/class_orientation.h"
#include <Eigen/Core>

#include "facet_mapping/labeling/alpha_expansion.h"
#include "facet_mapping/labeling/facet_labeling.h"

namespace facet_mapping {

/// Facets by class: those now labelled with it, or those that `fallback` gives it where the labels
/// give it too few (min_normal_facets), or none where that does too. Facets without area take no
/// part. The vectors must outlive the object.
class ClassFacets {
 public:
  /// `labels` and `fallback` hold kNoClass or a class; `normals`: unit normals times area.
  ClassFacets(const std::vector<Eigen::Vector3d>& normals,
              const std::vector<ClassIndex>& labels,
              const std::vector<ClassIndex>& fallback,
              std::size_t classes,
              const LabelingConfig& config);

  const std::vector<Eigen::Vector3d>& normals() const { return normals_; }
  /// Per class, ascending; empty for classes without a prior.
  const std::vector<FacetList>& all() const { return all_; }
  /// Those of them that are in `facets`, per class.
  std::vector<FacetList> among(const FacetList& facets) const;

 private:
  enum class Source : std::uint8_t { kLabels, kFallback, kNone };
  void choose_source(Source source, std::size_t least);

  const std::vector<Eigen::Vector3d>& normals_;
  const std::vector<ClassIndex>& labels_;
  const std::vector<ClassIndex>& fallback_;
  std::vector<Source> sources_;
  std::vector<FacetList> all_;
};

}  // namespace facet_mapping
