// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/track_points.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <utility>

#include "excluded_labels.h"
#include "track.h"
#include "track_checks.h"
#include "track_matching.h"
#include "track_start.h"
#include "track_triangulation.h"
#include <tbb/parallel_for.h>

#include "facet_mapping/geometry/median.h"

namespace facet_mapping {
namespace {

using detail::Observation;
using detail::Track;
using detail::TrackImage;
using detail::TrackMatch;
using detail::UsedView;

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
/// So many tracks with a point say something about the pose when they get lost ...
constexpr std::size_t kMinWitnesses = 20;
/// ... if no more than this share of them is found again.
constexpr double kMinFoundShare = 0.2;
/// Fewer matches do not show that the camera stands still.
constexpr std::size_t kMinStillMatches = 10;
/// The image is used after this much motion in it, whatever the parallax (share of the width).
constexpr double kMaxTurn = 0.05;

Label label_at(const cv::Mat& labels, const Eigen::Vector2d& pixel) {
  if (labels.empty()) {
    return kUnlabelled;
  }
  const int x = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, labels.cols - 1);
  const int y = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, labels.rows - 1);
  return labels.at<Label>(y, x);
}

Observation observe(const TrackImage& image,
                    const std::shared_ptr<const UsedView>& from,
                    const Eigen::Vector2d& pixel,
                    bool is_corner) {
  return {from,
          pixel,
          is_corner ? Eigen::Vector2d::Zero() : detail::edge_normal(image.gray, pixel),
          label_at(image.labels, pixel)};
}

TrackImage make_image(const cv::Mat& gray, const View& view, const cv::Mat& labels) {
  return {view, gray.clone(), detail::even_image(gray), labels.clone()};
}

void count(const std::vector<Track>& tracks,
           const std::vector<TrackMatch>& matches,
           TrackReport* report) {
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    if (tracks[k].is_alive) {
      const TrackMatch::Kind kind = matches[k].kind;
      ++report->followed;
      report->matched += kind == TrackMatch::Kind::kFound ? 1 : 0;
      report->no_match += kind == TrackMatch::Kind::kNone ? 1 : 0;
      report->ambiguous += kind == TrackMatch::Kind::kAmbiguous ? 1 : 0;
      report->off_epipolar += kind == TrackMatch::Kind::kOffEpipolar ? 1 : 0;
    }
  }
}

}  // namespace

class FeatureTracker::State {
 public:
  explicit State(const TrackConfig& config) : config_(config) {}

  std::vector<PointFrame> add(TrackImage image, double stamp, TrackReport* report) {
    std::vector<PointFrame> frames;
    if (!waiting_.empty() && (image.gray.size() != last_.gray.size() || stamp < last_stamp_)) {
      frames = finish(report);
      report->restarted = true;
    }
    std::vector<TrackMatch> matches;
    if (!waiting_.empty()) {
      matches = detail::match_tracks(tracks_, last_, image, config_);
      count(tracks_, matches, report);
      if (is_still(matches)) {
        report->still = true;
        return frames;
      }
    }
    use(std::move(image), stamp, matches, report);
    while (waiting_.size() > static_cast<std::size_t>(config_.window)) {
      release(&frames, report);
    }
    return frames;
  }

  std::vector<PointFrame> finish(TrackReport* report) {
    std::vector<PointFrame> frames;
    while (!waiting_.empty()) {
      release(&frames, report);
    }
    tracks_.clear();
    last_ = {};
    used_ = 0;
    return frames;
  }

 private:
  bool is_still(const std::vector<TrackMatch>& matches) const {
    std::vector<double> parallax;
    std::vector<double> motion;
    for (std::size_t k = 0; k < matches.size(); ++k) {
      if (matches[k].kind == TrackMatch::Kind::kFound) {
        parallax.push_back(matches[k].parallax_px);
        motion.push_back((matches[k].pixel - tracks_[k].last().pixel).norm());
      }
    }
    return parallax.size() >= kMinStillMatches && median(parallax) < config_.min_motion_px &&
           median(motion) < kMaxTurn * last_.gray.cols;
  }

  void use(TrackImage image,
           double stamp,
           const std::vector<TrackMatch>& matches,
           TrackReport* report) {
    const auto from = std::make_shared<const UsedView>(UsedView{image.view, stamp, used_++});
    continue_tracks(image, from, matches, report);
    start_tracks(image, from, report);
    waiting_.push_back(from);
    last_ = std::move(image);
    last_stamp_ = stamp;
    report->used = true;
  }

  void continue_tracks(const TrackImage& image,
                       const std::shared_ptr<const UsedView>& from,
                       const std::vector<TrackMatch>& matches,
                       TrackReport* report) {
    std::vector<char> is_inconsistent(tracks_.size(), 0);
    std::vector<char> is_witness(tracks_.size(), 0);
    tbb::parallel_for(std::size_t{0}, matches.size(), [&](std::size_t k) {
      Track& track = tracks_[k];
      is_witness[k] = track.is_alive && track.point.has_value() ? 1 : 0;
      const bool is_found = track.is_alive && matches[k].kind == TrackMatch::Kind::kFound;
      is_inconsistent[k] = is_found && !extend(image, from, matches[k], &track) ? 1 : 0;
      track.is_alive = is_found && is_inconsistent[k] == 0;
    });
    std::size_t witnesses = 0;
    std::size_t found = 0;
    for (std::size_t k = 0; k < tracks_.size(); ++k) {
      report->inconsistent += is_inconsistent[k];
      witnesses += is_witness[k];
      found += is_witness[k] != 0 && tracks_[k].is_alive ? 1 : 0;
    }
    if (witnesses >= kMinWitnesses &&
        static_cast<double>(found) < kMinFoundShare * static_cast<double>(witnesses)) {
      end_all(from->number);
      report->restarted = true;
    }
  }

  /// False if the observation does not fit the others; the track then stays as it was.
  bool extend(const TrackImage& image,
              const std::shared_ptr<const UsedView>& from,
              const TrackMatch& match,
              Track* track) const {
    track->observations.push_back(observe(image, from, match.pixel, track->last().is_corner()));
    const auto point = detail::triangulate_track(track->observations, config_.pixel_sigma);
    if (point && point->rms_px > config_.max_reprojection_px) {
      track->observations.pop_back();
      return false;
    }
    track->point = point;
    return true;
  }

  /// Ends all tracks; what they have from image `number`, which does not fit the ones before, is
  /// taken off.
  void end_all(std::size_t number) {
    for (Track& track : tracks_) {
      track.is_alive = false;
      if (track.last().from->number == number) {
        track.observations.pop_back();
        track.point = detail::triangulate_track(track.observations, config_.pixel_sigma);
      }
    }
  }

  void start_tracks(const TrackImage& image,
                    const std::shared_ptr<const UsedView>& from,
                    TrackReport* report) {
    std::vector<Eigen::Vector2d> taken;
    for (const Track& track : tracks_) {
      if (track.is_alive) {
        taken.push_back(track.last().pixel);
      }
    }
    const detail::NewFeatures features =
        detail::find_features(image.gray, image.even, image.labels, taken, config_);
    for (const Eigen::Vector2d& corner : features.corners) {
      tracks_.push_back({{observe(image, from, corner, true)}, {}, true});
    }
    for (const Eigen::Vector2d& edge : features.edges) {
      tracks_.push_back({{observe(image, from, edge, false)}, {}, true});
    }
    report->started_corners = features.corners.size();
    report->started_edges = features.edges.size();
  }

  /// Takes the oldest waiting image off the queue and appends its points, if it has any.
  void release(std::vector<PointFrame>* frames, TrackReport* report) {
    const std::shared_ptr<const UsedView> from = waiting_.front();
    waiting_.pop_front();
    PointFrame frame{from->stamp, from->view.world_from_cam, {}};
    for (const Track& track : tracks_) {
      add_point(track, *from, &frame.points, report);
    }
    tracks_.erase(std::remove_if(tracks_.begin(),
                                 tracks_.end(),
                                 [&](const Track& track) {
                                   return !track.is_alive &&
                                          track.last().from->number <= from->number;
                                 }),
                  tracks_.end());
    report->points += frame.points.size();
    if (!frame.points.empty()) {
      frames->push_back(std::move(frame));
    }
  }

  void add_point(const Track& track,
                 const UsedView& from,
                 std::vector<LabeledPoint>* points,
                 TrackReport* report) const {
    const std::size_t first = track.observations.front().from->number;
    if (from.number < first || from.number > track.last().from->number) {
      return;
    }
    if (track.observations.size() < static_cast<std::size_t>(config_.min_observations)) {
      ++report->too_few_views;
      return;
    }
    if (!track.point || track.point->parallax_rad < config_.min_parallax_deg * kRadiansPerDegree) {
      ++report->imprecise;
      return;
    }
    const Eigen::Vector3d in_cam = from.view.cam_from_world() * track.point->position;
    const double sigma = track.point->sigma_from(from.view.center());
    if (!(sigma <= config_.max_relative_sigma * in_cam.z())) {
      ++report->imprecise;
      return;
    }
    const Label label = track.observations[from.number - first].label;
    if (!(in_cam.z() >= config_.min_depth_m && in_cam.z() <= config_.max_depth_m) ||
        detail::is_excluded(label, config_.excluded_labels)) {
      ++report->out_of_range;
      return;
    }
    points->push_back({in_cam.cast<float>(), label, static_cast<float>(sigma)});
  }

  TrackConfig config_;
  std::vector<Track> tracks_;
  std::deque<std::shared_ptr<const UsedView>> waiting_;  // used images, oldest first
  TrackImage last_;
  double last_stamp_ = 0.0;
  std::size_t used_ = 0;
};

FeatureTracker::FeatureTracker(const TrackConfig& config) {
  detail::check_track_config(config);
  state_ = std::make_unique<State>(config);
}

FeatureTracker::~FeatureTracker() = default;
FeatureTracker::FeatureTracker(FeatureTracker&&) noexcept = default;
FeatureTracker& FeatureTracker::operator=(FeatureTracker&&) noexcept = default;

std::vector<PointFrame> FeatureTracker::add(const cv::Mat& gray,
                                            const View& view,
                                            const cv::Mat& labels,
                                            double stamp,
                                            TrackReport* report) {
  TrackReport own;
  TrackReport& counts = report != nullptr ? *report : own;
  counts = {};
  detail::check_track_image(gray, view.camera, labels);
  if (!is_rigid(view.world_from_cam) || !std::isfinite(stamp)) {
    counts.bad_pose = true;
    return {};
  }
  return state_->add(make_image(gray, view, labels), stamp, &counts);
}

std::vector<PointFrame> FeatureTracker::finish(TrackReport* report) {
  TrackReport own;
  TrackReport& counts = report != nullptr ? *report : own;
  counts = {};
  return state_->finish(&counts);
}

}  // namespace facet_mapping
