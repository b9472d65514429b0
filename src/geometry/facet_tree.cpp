// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/facet_tree.h"

#include <numeric>

namespace facet_mapping {

void fill_tree(const FacetSource& source, FacetTree* tree) {
  std::vector<std::uint32_t> facets(source.triangles->size());
  std::iota(facets.begin(), facets.end(), 0);
  tree->insert(facets.cbegin(), facets.cend(), source);
  tree->build();
}

}  // namespace facet_mapping
