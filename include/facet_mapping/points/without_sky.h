// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {

/// The configuration of a source of points, pixels of sky classes excluded.
template <typename Config>
Config without_sky(Config config, const LabelSet& labels) {
  config.excluded_labels = labels.sky_ids();
  return config;
}

}  // namespace facet_mapping
