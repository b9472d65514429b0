// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Feature tracks in a scene with exact depth.
#include "facet_mapping/points/track_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "track_scenes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using test::TrackPicture;
using test::TrackScene;

std::vector<TrackPicture> drive(const TrackScene& scene, int frames, const Eigen::Vector3d& step) {
  std::vector<TrackPicture> pictures;
  for (int k = 0; k < frames; ++k) {
    pictures.push_back(test::take_picture(scene, test::track_view(k * step)));
  }
  return pictures;
}

const std::vector<TrackPicture>& sideways() {
  static const std::vector<TrackPicture> pictures = drive(TrackScene(), 8, {0.25, 0.0, 0.0});
  return pictures;
}

struct Tracked {
  std::vector<PointFrame> frames;
  std::vector<TrackReport> reports;

  std::size_t points() const {
    std::size_t sum = 0;
    for (const PointFrame& frame : frames) {
      sum += frame.points.size();
    }
    return sum;
  }
};

Tracked track(const std::vector<TrackPicture>& pictures, const TrackConfig& config = {}) {
  FeatureTracker tracker(config);
  Tracked result;
  double stamp = 0.0;
  for (const TrackPicture& picture : pictures) {
    result.reports.emplace_back();
    for (PointFrame& frame :
         tracker.add(picture.gray, picture.view, picture.labels, stamp, &result.reports.back())) {
      result.frames.push_back(std::move(frame));
    }
    stamp += 0.1;
  }
  for (PointFrame& frame : tracker.finish()) {
    result.frames.push_back(std::move(frame));
  }
  return result;
}

struct Accuracy {
  std::size_t points = 0;
  double within_two_sigma = 0.0;  // share
  double within_5_percent = 0.0;  // share
};

/// Difference to the scene's depth at the point's pixel; at an outline, where a pixel decides which
/// surface is meant, to the nearer of the depths on both sides.
double depth_error(const TrackScene& scene, const View& view, const Eigen::Vector3d& in_cam) {
  constexpr double kAside = 3.0;  // pixels
  const Eigen::Vector2d pixel = view.camera.project(in_cam);
  const double truth = test::hit_from(scene, view, pixel).depth;
  double error = std::abs(in_cam.z() - truth);
  for (const Eigen::Vector2d& aside :
       {Eigen::Vector2d(kAside, 0.0), Eigen::Vector2d(0.0, kAside)}) {
    for (const double side : {-1.0, 1.0}) {
      const double other = test::hit_from(scene, view, pixel + side * aside).depth;
      if (std::abs(other - truth) > 0.1 * truth) {
        error = std::min(error, std::abs(in_cam.z() - other));
      }
    }
  }
  return error;
}

Accuracy accuracy(const Tracked& tracked, const TrackScene& scene) {
  Accuracy result;
  for (const PointFrame& frame : tracked.frames) {
    const View view{test::track_view(Eigen::Vector3d::Zero()).camera, frame.world_from_sensor};
    for (const LabeledPoint& point : frame.points) {
      const double error = depth_error(scene, view, point.position.cast<double>());
      ++result.points;
      result.within_two_sigma += error <= 2.0 * point.sigma ? 1.0 : 0.0;
      result.within_5_percent += error <= 0.05 * point.position.z() ? 1.0 : 0.0;
    }
  }
  result.within_two_sigma /= static_cast<double>(result.points);
  result.within_5_percent /= static_cast<double>(result.points);
  return result;
}

TEST(TrackPoints, DepthsAgreeWithTheSceneToWithinTheirSigma) {
  const Accuracy found = accuracy(track(sideways()), TrackScene());
  EXPECT_GT(found.points, 3000U);
  EXPECT_GT(found.within_two_sigma, 0.95);
  EXPECT_GT(found.within_5_percent, 0.97);
}

TEST(TrackPoints, MovingForwardGivesPointsButNoneNearTheFocusOfExpansion) {
  const TrackScene scene;
  const Tracked tracked = track(drive(scene, 9, {0.0, 0.0, 0.3}));
  const Accuracy found = accuracy(tracked, scene);
  EXPECT_GT(found.points, 1000U);
  EXPECT_GT(found.within_two_sigma, 0.93);
  for (const PointFrame& frame : tracked.frames) {
    for (const LabeledPoint& point : frame.points) {
      const Eigen::Vector2d pixel =
          test::track_view(Eigen::Vector3d::Zero()).camera.project(point.position.cast<double>());
      EXPECT_GT((pixel - Eigen::Vector2d(159.5, 119.5)).norm(), 12.0);
      EXPECT_LE(point.sigma, 0.05 * point.position.z() + 1e-6);
    }
  }
}

TEST(TrackPoints, StandingStillGivesNoPointsAndSaysSo) {
  const Tracked tracked = track(drive(TrackScene(), 5, Eigen::Vector3d::Zero()));
  EXPECT_EQ(tracked.points(), 0U);
  EXPECT_TRUE(tracked.reports[0].used);
  for (std::size_t k = 1; k < tracked.reports.size(); ++k) {
    EXPECT_TRUE(tracked.reports[k].still);
    EXPECT_FALSE(tracked.reports[k].used);
    EXPECT_GT(tracked.reports[k].matched, 300U);
  }
}

TEST(TrackPoints, TurningOnTheSpotKeepsTracksButGivesNoPoints) {
  std::vector<TrackPicture> pictures;
  for (int k = 0; k < 10; ++k) {
    pictures.push_back(
        test::take_picture(TrackScene(), test::track_view(Eigen::Vector3d::Zero(), 0.03 * k)));
  }
  const Tracked tracked = track(pictures);
  EXPECT_EQ(tracked.points(), 0U);
  EXPECT_GT(tracked.reports.back().matched, 300U);
  EXPECT_TRUE(tracked.reports[2].used);
}

TEST(TrackPoints, MovingThingsGiveNoPoints) {
  std::vector<TrackPicture> pictures;
  for (int k = 0; k < 8; ++k) {
    TrackScene scene;
    scene.walls.push_back(
        {{0.5, -1.5, 5.0}, {2.5, 2.0}, test::kMover, Eigen::Vector3d(0.05, 0.15, 0.0) * k});
    pictures.push_back(test::take_picture(scene, test::track_view({0.25 * k, 0.0, 0.0})));
  }
  std::map<Label, std::size_t> counts;
  for (const PointFrame& frame : track(pictures).frames) {
    for (const LabeledPoint& point : frame.points) {
      ++counts[point.label];
    }
  }
  EXPECT_GT(counts[test::kWall], 2000U);
  // At rest it would have a fifth of all points. What is left are edges that lie along its motion,
  // which look the same wherever they are.
  EXPECT_LT(counts[test::kMover], counts[test::kWall] / 40);
}

TEST(TrackPoints, AJumpOfTheExposureLosesFewPoints) {
  std::vector<TrackPicture> pictures = sideways();
  for (std::size_t k = 4; k < pictures.size(); ++k) {
    cv::Mat darker;  // the pictures share their pixels with other tests
    pictures[k].gray.convertTo(darker, CV_8U, 0.5, 25.0);
    pictures[k].gray = darker;
  }
  const Accuracy found = accuracy(track(pictures), TrackScene());
  EXPECT_GT(static_cast<double>(found.points),
            0.7 * static_cast<double>(track(sideways()).points()));
  EXPECT_GT(found.within_two_sigma, 0.93);
}

TEST(TrackPoints, APointIsAtOnePlaceInAllFramesThatSawIt) {
  using Key = std::array<long, 3>;
  std::map<Key, std::size_t> frames_of;
  for (const PointFrame& frame : track(sideways()).frames) {
    for (const LabeledPoint& point : frame.points) {
      const Eigen::Vector3d world = frame.world_from_sensor * point.position.cast<double>();
      ++frames_of[{std::lround(1e3 * world.x()),
                   std::lround(1e3 * world.y()),
                   std::lround(1e3 * world.z())}];
    }
  }
  std::size_t long_ones = 0;
  for (const auto& [place, frames] : frames_of) {
    EXPECT_LE(frames, sideways().size());
    long_ones += frames >= 3 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(long_ones), 0.9 * static_cast<double>(frames_of.size()));
}

TEST(TrackPoints, FramesComeOutAfterTheWindowInOrderWithTheirPoses) {
  TrackConfig config;
  config.window = 3;
  FeatureTracker tracker(config);
  for (std::size_t k = 0; k < sideways().size(); ++k) {
    const TrackPicture& picture = sideways()[k];
    const auto frames = tracker.add(picture.gray, picture.view, {}, static_cast<double>(k));
    ASSERT_EQ(frames.size(), k >= 3 ? 1U : 0U);
    if (k >= 3) {
      EXPECT_EQ(frames[0].stamp, static_cast<double>(k - 3));
      EXPECT_TRUE(frames[0].world_from_sensor.isApprox(sideways()[k - 3].view.world_from_cam));
      EXPECT_EQ(frames[0].points[0].label, kUnlabelled);
    }
  }
  EXPECT_EQ(tracker.finish().size(), 3U);
  EXPECT_TRUE(tracker.finish().empty());
}

TEST(TrackPoints, EqualInputGivesEqualPoints) {
  const Tracked first = track(sideways());
  const Tracked second = track(sideways());
  ASSERT_EQ(first.frames.size(), second.frames.size());
  for (std::size_t k = 0; k < first.frames.size(); ++k) {
    ASSERT_EQ(first.frames[k].points.size(), second.frames[k].points.size());
    for (std::size_t n = 0; n < first.frames[k].points.size(); ++n) {
      EXPECT_EQ(first.frames[k].points[n].position, second.frames[k].points[n].position);
      EXPECT_EQ(first.frames[k].points[n].sigma, second.frames[k].points[n].sigma);
    }
  }
}

TEST(TrackPoints, PointsHaveTheClassOfTheirPixelAndExcludedOnesGiveNone) {
  TrackConfig config;
  config.excluded_labels = {test::kFloor};
  std::size_t right = 0;
  std::size_t all = 0;
  for (const PointFrame& frame : track(sideways(), config).frames) {
    const View view{test::track_view(Eigen::Vector3d::Zero()).camera, frame.world_from_sensor};
    for (const LabeledPoint& point : frame.points) {
      EXPECT_NE(point.label, test::kFloor);
      const Eigen::Vector2d pixel = view.camera.project(point.position.cast<double>());
      right += point.label == test::hit_from(TrackScene(), view, pixel).label ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(static_cast<double>(right), 0.97 * static_cast<double>(all));
}

TEST(TrackPoints, ABrokenPoseIsLeftOutAndSaid) {
  std::vector<TrackPicture> pictures = sideways();
  pictures[3].view.world_from_cam.translation().x() = std::numeric_limits<double>::quiet_NaN();
  const Tracked tracked = track(pictures);
  EXPECT_TRUE(tracked.reports[3].bad_pose);
  EXPECT_FALSE(tracked.reports[3].used);
  EXPECT_FALSE(tracked.reports[4].restarted);
  EXPECT_GT(accuracy(tracked, TrackScene()).within_5_percent, 0.97);
}

TEST(TrackPoints, AJumpOfThePoseStartsAnewAndGivesNoWrongPoints) {
  std::vector<TrackPicture> pictures = sideways();
  for (std::size_t k = 4; k < pictures.size(); ++k) {
    pictures[k].view.world_from_cam.translation() += Eigen::Vector3d(0.0, 1.0, 0.0);
  }
  Tracked tracked = track(pictures);
  EXPECT_TRUE(tracked.reports[4].restarted);
  EXPECT_FALSE(tracked.reports[5].restarted);
  for (PointFrame& frame : tracked.frames) {
    frame.world_from_sensor.translation().y() = 0.0;
  }
  const Accuracy found = accuracy(tracked, TrackScene());
  EXPECT_GT(found.points, 1000U);
  EXPECT_GT(found.within_5_percent, 0.96);
}

TEST(TrackPoints, AnotherSizeOrTimeGoingBackStartsAnewAndWhatWaitedComesOut) {
  FeatureTracker tracker;
  for (int k = 0; k < 4; ++k) {
    const TrackPicture& picture = sideways()[static_cast<std::size_t>(k)];
    tracker.add(picture.gray, picture.view, picture.labels, k);
  }
  TrackReport report;
  EXPECT_EQ(tracker.add(sideways()[4].gray, sideways()[4].view, {}, 0.5, &report).size(), 4U);
  EXPECT_TRUE(report.restarted);
  TrackPicture half = sideways()[5];
  half.view.camera = half.view.camera.resized(160, 240);
  EXPECT_TRUE(tracker.add(half.gray.colRange(0, 160), half.view, {}, 1.0, &report).empty());
  EXPECT_TRUE(report.restarted);
  EXPECT_TRUE(report.used);
}

TEST(TrackPoints, AGreyImageIsUsedAndGivesNothing) {
  std::vector<TrackPicture> pictures = sideways();
  for (TrackPicture& picture : pictures) {
    picture.gray = cv::Mat(picture.gray.size(), CV_8UC1, cv::Scalar(90));
  }
  const Tracked tracked = track(pictures);
  EXPECT_EQ(tracked.points(), 0U);
  EXPECT_EQ(tracked.reports[3].followed, 0U);
}

TEST(TrackPoints, WhatDoesNotFitIsRefused) {
  TrackConfig config;
  config.min_observations = 1;
  EXPECT_THROW(FeatureTracker{config}, std::invalid_argument);
  FeatureTracker tracker;
  const TrackPicture& picture = sideways()[0];
  EXPECT_THROW(tracker.add({}, picture.view, {}, 0.0), std::invalid_argument);
  EXPECT_THROW(tracker.add(picture.gray.rowRange(0, 100), picture.view, {}, 0.0),
               std::invalid_argument);
  EXPECT_THROW(tracker.add(picture.gray, picture.view, picture.gray, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
