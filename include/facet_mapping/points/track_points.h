// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labelled points from one moving camera whose poses are known: features are followed from image to
// image and triangulated over all images that see them.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

/// Lengths in metres are the only numbers here that depend on the scene's unit.
struct TrackConfig {
  int corner_cell_px = 10;             ///< corners keep this distance from each other
  int edge_cell_px = 6;                ///< at most one new edge point per cell of this size
  double min_corner = 0.02;            ///< weakest corner against the strongest, 0 to 1
  double min_gradient = 6.0;           ///< weakest edge, 8-bit units per pixel
  int patch_radius_px = 4;             ///< patches are squares of 2 * radius + 1 pixels
  double min_likeness = 0.85;          ///< least normalised cross-correlation of a match, 0 to 1
  double min_uniqueness = 0.03;        ///< the second-best match must be less like by this
  double epipolar_tolerance_px = 1.5;  ///< farther from its epipolar line a match is no match
  double round_trip_px = 0.7;          ///< matching back must end this near to the start
  double min_motion_px = 1.5;          ///< images with a smaller median parallax are not used
  int min_observations = 3;            ///< images that must have seen a point
  int window = 8;            ///< used images that a used image waits for before its points are out
  double pixel_sigma = 0.5;  ///< noise of a match in pixels, which a point's sigma comes from
  double max_reprojection_px = 1.0;    ///< larger root mean square of a track's residuals: dropped
  double min_parallax_deg = 1.0;       ///< smallest angle between the outermost rays to a point
  double max_relative_sigma = 0.05;    ///< points with sigma / depth above this are dropped
  double min_depth_m = 1.0;            ///< nearer points are dropped
  double max_depth_m = 60.0;           ///< farther points are dropped
  std::vector<Label> excluded_labels;  ///< pixels of these classes (sky) give no points
};

/// What became of one image and of the tracks in it.
struct TrackReport {
  bool used = false;          ///< false: one of the next two says why
  bool bad_pose = false;      ///< the pose is not finite or not rigid: the image was ignored
  bool still = false;         ///< no parallax since the last used image: this one was left out
  bool restarted = false;     ///< other size, time going back, or nearly all tracks lost at once (a
                              ///< jump of the pose): all tracks were ended
  std::size_t followed = 0;   ///< tracks that were looked for
  std::size_t matched = 0;    ///< ... and found
  std::size_t no_match = 0;   ///< nothing alike on the epipolar line, or out of the image
  std::size_t ambiguous = 0;  ///< alike in two places, or not found on the way back
  std::size_t off_epipolar = 0;  ///< off the epipolar line: on a moving object, or lost
  std::size_t inconsistent = 0;  ///< the images agree on no position
  std::size_t started_corners = 0;
  std::size_t started_edges = 0;
  std::size_t points = 0;         ///< in the frames returned
  std::size_t too_few_views = 0;  ///< observations without a point: seen too seldom,
  std::size_t imprecise = 0;     ///< parallax too small or sigma too large (near the epipole, too),
  std::size_t out_of_range = 0;  ///< or too near, too far, or of an excluded class
};

/// Corners (followed by pyramidal Lucas-Kanade flow from where the poses let them be) and edge
/// points (matched along the epipolar line only, as an edge says nothing about the motion along
/// it; Romanoni & Matteucci, "Incremental reconstruction of urban environments by edge-points
/// Delaunay triangulation", 2015).
///
/// Every used image gives one PointFrame, `window` used images later: all points that the image
/// observed, in that camera's frame, each at the position that all its observations up to then
/// give. So a point on a long track is in many frames, and the map, where it is one vertex, gets
/// one ray from each.
class FeatureTracker {
 public:
  /// Throws std::invalid_argument if the configuration is out of range.
  explicit FeatureTracker(const TrackConfig& config = {});
  ~FeatureTracker();
  FeatureTracker(FeatureTracker&&) noexcept;
  FeatureTracker& operator=(FeatureTracker&&) noexcept;

  /// Follows all tracks into the next image (CV_8UC1; `labels`: CV_16UC1 ids of the same size, or
  /// empty) and returns the frames that are complete now, oldest first, none of them empty.
  /// sigma: standard deviation along the ray of the frame's camera, from the geometry of all rays.
  /// Throws std::invalid_argument if image, labels and camera do not fit each other.
  std::vector<PointFrame> add(const cv::Mat& gray,
                              const View& view,
                              const cv::Mat& labels,
                              double stamp,
                              TrackReport* report = nullptr);

  /// Ends all tracks and returns the frames that still waited. The tracker is as new afterwards.
  std::vector<PointFrame> finish(TrackReport* report = nullptr);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace facet_mapping
