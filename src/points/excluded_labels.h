// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Classes whose pixels give no points.
#pragma once

#include <algorithm>
#include <vector>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping::detail {

inline bool is_excluded(Label label, const std::vector<Label>& excluded) {
  return std::find(excluded.begin(), excluded.end(), label) != excluded.end();
}

}  // namespace facet_mapping::detail
