// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dense labelled points from one moving camera whose poses are known: plane sweeping between
// keyframes.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

/// Lengths in metres are the only numbers here that depend on the scene's unit.
struct SweepConfig {
  int sweep_width_px = 800;  ///< wider images are swept at 1/2, 1/4 ... of their size; the points
                             ///< are then refined at full size
  int window = 2;            ///< used images before and after that a used image is compared with
  double min_motion = 0.04;  ///< images that moved less since the last used one are not used
                             ///< (share of the median depth)
  double max_parallax_deg = 45.0;  ///< images seen under a larger angle are not compared
  double plane_step_px =
      0.75;                ///< most motion of a pixel from a plane to the next, pixels as swept
  int max_planes = 192;    ///< of one direction; the step grows where more would be needed
  int max_directions = 3;  ///< directions of the scene (ground, facades) that are swept besides
                           ///< the planes that face the camera
  double min_uniqueness = 0.05;        ///< the second-best cost must be larger by this share
  double min_likeness = 0.7;           ///< least normalised cross-correlation at full size, 0 to 1
  int min_agreeing = 2;                ///< depths of other used images that must agree with a point
  double max_disagreement_px = 0.8;    ///< ... to within this motion between the images
  double pixel_sigma = 0.5;            ///< noise of a match in pixels, which sigma comes from
  double max_relative_sigma = 0.05;    ///< points with sigma / depth above this are dropped
  double min_depth_m = 2.0;            ///< nearer points are dropped
  double max_depth_m = 60.0;           ///< farther points are dropped
  int cell_px = 5;                     ///< at most one point per cell of this size ...
  double min_gradient = 4.0;           ///< ... the pixel of strongest gradient, if above this
                                       ///< (8-bit units per pixel)
  int flat_cell_px = 12;               ///< cell size where no pixel reaches min_gradient
  std::vector<Label> excluded_labels;  ///< pixels of these classes (sky) give no points
};

/// What became of one image, and of the images whose points came out with it.
struct SweepReport {
  bool used = false;           ///< false: one of the next two says why
  bool bad_pose = false;       ///< the pose is not finite or not rigid: the image was ignored
  bool still = false;          ///< it moved too little since the last used image (turning on the
                               ///< spot is no motion): it was left out
  bool restarted = false;      ///< other size or time going back: what waited came out
  std::size_t swept = 0;       ///< images that were swept
  std::size_t alone = 0;       ///< ... that could not be: no other image shows the same, or none
                               ///< from another place
  std::size_t directions = 0;  ///< directions of the scene's planes that the last one was swept in
  std::size_t planes = 0;      ///< planes in all directions, of the last one
  std::size_t pixels = 0;      ///< pixels, as swept, of the images whose points came out
  std::size_t unsure = 0;      ///< ... with another depth as likely, at a depth edge or in no image
  std::size_t inconsistent = 0;  ///< ... whose depth too few other images agree with
  std::size_t imprecise = 0;     ///< ... with a sigma too large (near the epipole, too)
  std::size_t out_of_range = 0;  ///< ... too near, too far, or of an excluded class
  std::size_t unlike = 0;        ///< chosen pixels that do not look alike at full size
  std::size_t points = 0;        ///< in the frames returned
};

/// Each used image is compared with those before and after it, on planes that face the camera and
/// on planes along the scene's dominant directions, which are learnt from the depths found (Haene,
/// Heng, Lee, Sizov, Pollefeys, "Real-time direct dense matching on fisheye images using
/// plane-sweeping stereo", 2014). The cost is that of a census (indifferent to exposure), of the
/// images before or of those after, whichever fits (occlusion); it is smoothed along each
/// direction's planes by semi-global matching (Hirschmueller 2008). Depths are refined at full size
/// and must agree with those of other used images.
///
/// Every used image gives one PointFrame, at most 2 * window used images later: at most one point
/// per cell, in that camera's frame.
class PlaneSweeper {
 public:
  /// Throws std::invalid_argument if the configuration is out of range.
  explicit PlaneSweeper(const SweepConfig& config = {});
  ~PlaneSweeper();
  PlaneSweeper(PlaneSweeper&&) noexcept;
  PlaneSweeper& operator=(PlaneSweeper&&) noexcept;

  /// Takes the next image (CV_8UC1; `labels`: CV_16UC1 ids of the same size, or empty) and returns
  /// the frames that are complete now, oldest first, none of them empty.
  /// sigma: standard deviation along the ray of the frame's camera, from parallax and pixel_sigma.
  /// Throws std::invalid_argument if image, labels and camera do not fit each other.
  std::vector<PointFrame> add(const cv::Mat& gray,
                              const View& view,
                              const cv::Mat& labels,
                              double stamp,
                              SweepReport* report = nullptr);

  /// Sweeps what still waits and returns its frames. The sweeper is as new afterwards.
  std::vector<PointFrame> finish(SweepReport* report = nullptr);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace facet_mapping
