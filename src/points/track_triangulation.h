// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Position of a feature from all its observations.
#pragma once

#include <optional>
#include <vector>

#include "track.h"

namespace facet_mapping::detail {

/// Least squares on the reprojection errors (Gauss-Newton from the point nearest to all rays); an
/// edge point's errors count across its edge. Nothing if the rays do not meet in front of all
/// cameras or have no angle between them. The covariance is that of `pixel_sigma`, or of the
/// residuals where these are larger, at two free observations.
std::optional<Triangulated> triangulate_track(const std::vector<Observation>& observations,
                                              double pixel_sigma);

}  // namespace facet_mapping::detail
