// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "labeling/class_facets.h"

#include <algorithm>
#include <numeric>

#include "labeling/votes.h"

namespace facet_mapping {

ClassFacets::ClassFacets(const std::vector<Eigen::Vector3d>& normals,
                         const std::vector<ClassIndex>& labels,
                         const std::vector<ClassIndex>& fallback,
                         std::size_t classes,
                         const LabelingConfig& config)
    : normals_(normals), labels_(labels), fallback_(fallback), sources_(classes, Source::kNone) {
  const auto least = static_cast<std::size_t>(std::max(config.min_normal_facets, 1));
  choose_source(Source::kLabels, least);
  choose_source(Source::kFallback, least);
  FacetList everything(normals.size());
  std::iota(everything.begin(), everything.end(), 0U);
  all_ = among(everything);
}

void ClassFacets::choose_source(Source source, std::size_t least) {
  const std::vector<ClassIndex>& from = source == Source::kLabels ? labels_ : fallback_;
  std::vector<std::size_t> count(sources_.size(), 0);
  for (std::size_t f = 0; f < from.size(); ++f) {
    if (from[f] != kNoClass && !normals_[f].isZero(0.0)) {
      ++count[from[f]];
    }
  }
  for (std::size_t k = 0; k < count.size(); ++k) {
    if (sources_[k] == Source::kNone && count[k] >= least) {
      sources_[k] = source;
    }
  }
}

std::vector<FacetList> ClassFacets::among(const FacetList& facets) const {
  std::vector<FacetList> chosen(sources_.size());
  for (const std::uint32_t f : facets) {
    if (normals_[f].isZero(0.0)) {
      continue;
    }
    if (labels_[f] != kNoClass && sources_[labels_[f]] == Source::kLabels) {
      chosen[labels_[f]].push_back(f);
    }
    if (fallback_[f] != kNoClass && sources_[fallback_[f]] == Source::kFallback) {
      chosen[fallback_[f]].push_back(f);
    }
  }
  return chosen;
}

}  // namespace facet_mapping
