// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "track_matching.h"

#include <algorithm>
#include <cmath>

#include "epipolar_search.h"
#include "track_start.h"
#include <opencv2/video/tracking.hpp>
#include <tbb/parallel_for.h>

namespace facet_mapping::detail {
namespace {

constexpr double kRangeSigmas = 3.0;
constexpr double kRangeMarginPx = 2.5;
/// Flow that ends farther from the match on the epipolar line has found something else.
constexpr double kFlowAgreementPx = 2.5;
/// An edge that its epipolar line crosses at a smaller angle than this (sine) is not matched.
constexpr double kMinCrossing = 0.35;
constexpr int kFlowWindowPx = 11;
constexpr int kFlowLevels = 1;  ///< besides the full size; the start is good

using Kind = TrackMatch::Kind;

InverseDepthRange whole_range(const TrackConfig& config) {
  return {0.0, 1.0 / config.min_depth_m};
}

InverseDepthRange around(double inverse_depth,
                         double sigma,
                         const EpipolarLine& line,
                         const TrackConfig& config) {
  const double rate = line.pixel_rate(inverse_depth).norm();
  const InverseDepthRange whole = whole_range(config);
  if (!(rate > 0.0)) {
    return whole;
  }
  const double reach = kRangeSigmas * sigma + kRangeMarginPx / rate;
  return {std::max(whole.low, inverse_depth - reach), std::min(whole.high, inverse_depth + reach)};
}

/// Where along its line a track can be: near its point, if it has one that is known well.
InverseDepthRange search_range(const Track& track,
                               const View& from,
                               const EpipolarLine& line,
                               const TrackConfig& config) {
  if (!track.point) {
    return whole_range(config);
  }
  const double depth = (from.cam_from_world() * track.point->position).z();
  if (!(depth >= config.min_depth_m)) {
    return whole_range(config);
  }
  const double sigma = track.point->sigma_from(from.center()) / (depth * depth);
  return around(1.0 / depth, sigma, line, config);
}

/// Matches of single tracks between two images.
class PairMatcher {
 public:
  PairMatcher(const TrackImage& from, const TrackImage& to, const TrackConfig& config)
      : from_(from),
        to_(to),
        config_(config),
        search_{config.patch_radius_px, config.min_likeness, config.min_uniqueness} {}

  /// On the epipolar line; for a corner the start of the flow.
  TrackMatch on_line(const Track& track) const {
    const Observation& last = track.last();
    const EpipolarLine line(from_.view, to_.view, last.pixel);
    const InverseDepthRange range = search_range(track, from_.view, line, config_);
    const EpipolarMatch found =
        search_epipolar(from_.gray, last.pixel, to_.gray, line, to_.view.camera, range, search_);
    if (found.kind != EpipolarMatch::Kind::kFound) {
      const bool none = found.kind == EpipolarMatch::Kind::kNone;
      return {none ? Kind::kNone : Kind::kAmbiguous, {}, 0.0};
    }
    if (!last.is_corner() && !is_edge_match(track, line, found)) {
      return {Kind::kAmbiguous, {}, 0.0};
    }
    return {Kind::kFound, found.pixel, (found.pixel - line.pixel(0.0)).norm()};
  }

  /// What the flow forth and back says about a corner matched on the line.
  TrackMatch check_corner(const Observation& last,
                          const TrackMatch& match,
                          const Eigen::Vector2d& flow_end,
                          const Eigen::Vector2d& way_back_end) const {
    const EpipolarLine line(from_.view, to_.view, last.pixel);
    if (!((way_back_end - last.pixel).norm() <= config_.round_trip_px)) {
      return {Kind::kAmbiguous, {}, 0.0};
    }
    if (!(line.distance(flow_end) <= config_.epipolar_tolerance_px)) {
      return {Kind::kOffEpipolar, {}, 0.0};
    }
    if (!((flow_end - match.pixel).norm() <= kFlowAgreementPx)) {
      return {Kind::kAmbiguous, {}, 0.0};
    }
    return {Kind::kFound, flow_end, (flow_end - line.pixel(0.0)).norm()};
  }

 private:
  /// True if the edge crosses its line and the match is found back from the other image.
  bool is_edge_match(const Track& track,
                     const EpipolarLine& line,
                     const EpipolarMatch& found) const {
    const Eigen::Vector2d along = line.pixel_rate(found.inverse_depth);
    const double crossing = std::abs(along.dot(edge_normal(to_.gray, found.pixel)));
    if (along.norm() > 0.0 && !(crossing >= kMinCrossing * along.norm())) {
      return false;
    }
    const EpipolarLine back(to_.view, from_.view, found.pixel);
    const double inverse_depth = found.inverse_depth / line.depth_ratio(found.inverse_depth);
    const InverseDepthRange range =
        track.point ? around(inverse_depth, 0.0, back, config_) : whole_range(config_);
    const EpipolarMatch again =
        search_epipolar(to_.gray, found.pixel, from_.gray, back, from_.view.camera, range, search_);
    return again.kind == EpipolarMatch::Kind::kFound &&
           (again.pixel - track.last().pixel).norm() <= config_.round_trip_px;
  }

  const TrackImage& from_;
  const TrackImage& to_;
  const TrackConfig& config_;
  EpipolarSearchConfig search_;
};

cv::Point2f to_cv(const Eigen::Vector2d& pixel) {
  return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
}

/// Ends of the flow from `points`, NaN where it found none.
std::vector<Eigen::Vector2d> flow(const cv::Mat& from,
                                  const cv::Mat& to,
                                  const std::vector<cv::Point2f>& points,
                                  std::vector<cv::Point2f> ends) {
  std::vector<std::uint8_t> found;
  cv::calcOpticalFlowPyrLK(from,
                           to,
                           points,
                           ends,
                           found,
                           cv::noArray(),
                           {kFlowWindowPx, kFlowWindowPx},
                           kFlowLevels,
                           {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  std::vector<Eigen::Vector2d> result;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const bool is_inside = found[k] != 0 && ends[k].x >= 0.0F && ends[k].y >= 0.0F &&
                           ends[k].x <= static_cast<float>(to.cols - 1) &&
                           ends[k].y <= static_cast<float>(to.rows - 1);
    result.emplace_back(is_inside ? Eigen::Vector2d(ends[k].x, ends[k].y)
                                  : Eigen::Vector2d::Constant(std::nan("")));
  }
  return result;
}

/// Replaces the corners' matches by what the flow finds from there, freely in both directions of
/// the image: what moves by itself leaves the line.
void follow_corners(const std::vector<Track>& tracks,
                    const TrackImage& from,
                    const TrackImage& to,
                    const PairMatcher& matcher,
                    std::vector<TrackMatch>* matches) {
  std::vector<std::size_t> which;
  std::vector<cv::Point2f> starts;
  std::vector<cv::Point2f> guesses;
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    if ((*matches)[k].kind == Kind::kFound && tracks[k].last().is_corner()) {
      which.push_back(k);
      starts.push_back(to_cv(tracks[k].last().pixel));
      guesses.push_back(to_cv((*matches)[k].pixel));
    }
  }
  if (which.empty()) {
    return;
  }
  const std::vector<Eigen::Vector2d> ends = flow(from.even, to.even, starts, guesses);
  std::vector<cv::Point2f> back_starts = guesses;
  for (std::size_t n = 0; n < ends.size(); ++n) {
    back_starts[n] = ends[n].allFinite() ? to_cv(ends[n]) : guesses[n];
  }
  const std::vector<Eigen::Vector2d> back = flow(to.even, from.even, back_starts, starts);
  for (std::size_t n = 0; n < which.size(); ++n) {
    TrackMatch& match = (*matches)[which[n]];
    match = matcher.check_corner(tracks[which[n]].last(), match, ends[n], back[n]);
  }
}

}  // namespace

std::vector<TrackMatch> match_tracks(const std::vector<Track>& tracks,
                                     const TrackImage& from,
                                     const TrackImage& to,
                                     const TrackConfig& config) {
  const PairMatcher matcher(from, to, config);
  std::vector<TrackMatch> matches(tracks.size());
  tbb::parallel_for(std::size_t{0}, tracks.size(), [&](std::size_t k) {
    if (tracks[k].is_alive) {
      matches[k] = matcher.on_line(tracks[k]);
    }
  });
  follow_corners(tracks, from, to, matcher, &matches);
  return matches;
}

}  // namespace facet_mapping::detail
