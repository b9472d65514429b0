// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {

/// Throws std::invalid_argument with all problems at once.
void check(const StreetConfig& config);

}  // namespace facet_mapping
