// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One short street for the tests of this room; made once.
#pragma once

#include "facet_mapping/synthetic/street.h"
#include "facet_mapping/synthetic/street_rig.h"

namespace facet_mapping::testing {

inline const Street& short_street() {
  static const Street kStreet = [] {
    StreetConfig config;
    config.length_m = 30.0;
    config.seed = 3;
    config.bend_rad = 0.1;
    return make_street(config);
  }();
  return kStreet;
}

}  // namespace facet_mapping::testing
