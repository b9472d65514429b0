// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finding the tracks of one image in the next one.
#pragma once

#include <vector>

#include "track.h"

#include "facet_mapping/points/track_points.h"

namespace facet_mapping::detail {

struct TrackMatch {
  enum class Kind { kFound, kNone, kAmbiguous, kOffEpipolar };
  Kind kind = Kind::kNone;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double parallax_px = 0.0;  ///< distance from where a point at infinity would be
};

/// One match for each track, whose last observation is in `from`; dead tracks get none.
std::vector<TrackMatch> match_tracks(const std::vector<Track>& tracks,
                                     const TrackImage& from,
                                     const TrackImage& to,
                                     const TrackConfig& config);

}  // namespace facet_mapping::detail
