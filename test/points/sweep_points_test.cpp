// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Plane sweeping in a scene with exact depth.
#include "facet_mapping/points/sweep_points.h"

#include <algorithm>
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

const PinholeCamera kCamera = test::track_view(Eigen::Vector3d::Zero()).camera;

SweepConfig near_scene() {
  SweepConfig config;
  config.min_motion = 0.02;
  config.min_depth_m = 2.0;
  config.max_depth_m = 20.0;
  config.max_planes = 64;
  return config;
}

std::vector<TrackPicture> drive(const TrackScene& scene, int frames, const Eigen::Vector3d& step) {
  std::vector<TrackPicture> pictures;
  pictures.reserve(static_cast<std::size_t>(frames));
  for (int k = 0; k < frames; ++k) {
    pictures.push_back(test::take_picture(scene, test::track_view(k * step)));
  }
  return pictures;
}

const std::vector<TrackPicture>& sideways() {
  static const std::vector<TrackPicture> pictures = drive(TrackScene(), 6, {0.25, 0.0, 0.0});
  return pictures;
}

struct Swept {
  std::vector<PointFrame> frames;
  std::vector<SweepReport> reports;
  SweepReport last;  // of finish()

  std::size_t points() const {
    std::size_t sum = 0;
    for (const PointFrame& frame : frames) {
      sum += frame.points.size();
    }
    return sum;
  }
};

Swept sweep(const std::vector<TrackPicture>& pictures, const SweepConfig& config = near_scene()) {
  PlaneSweeper sweeper(config);
  Swept result;
  double stamp = 0.0;
  for (const TrackPicture& picture : pictures) {
    result.reports.emplace_back();
    for (PointFrame& frame :
         sweeper.add(picture.gray, picture.view, picture.labels, stamp, &result.reports.back())) {
      result.frames.push_back(std::move(frame));
    }
    stamp += 0.1;
  }
  for (PointFrame& frame : sweeper.finish(&result.last)) {
    result.frames.push_back(std::move(frame));
  }
  return result;
}

const Swept& swept_sideways() {
  static const Swept swept = sweep(sideways());
  return swept;
}

struct Accuracy {
  std::size_t points = 0;
  std::map<Label, std::size_t> of_class;
  double within_two_sigma = 0.0;  // share
  double within_1_percent = 0.0;  // share
  double within_5_percent = 0.0;  // share
};

Accuracy accuracy(const std::vector<PointFrame>& frames, const TrackScene& scene) {
  Accuracy result;
  for (const PointFrame& frame : frames) {
    const View view{kCamera, frame.world_from_sensor};
    for (const LabeledPoint& point : frame.points) {
      const Eigen::Vector3d in_cam = point.position.cast<double>();
      const double truth = test::hit_from(scene, view, kCamera.project(in_cam)).depth;
      const double error = std::abs(in_cam.z() - truth);
      ++result.points;
      ++result.of_class[point.label];
      result.within_two_sigma += error <= 2.0 * point.sigma ? 1.0 : 0.0;
      result.within_1_percent += error <= 0.01 * truth ? 1.0 : 0.0;
      result.within_5_percent += error <= 0.05 * truth ? 1.0 : 0.0;
    }
  }
  for (double* share :
       {&result.within_two_sigma, &result.within_1_percent, &result.within_5_percent}) {
    *share /= static_cast<double>(result.points);
  }
  return result;
}

TEST(SweepPoints, DepthsAgreeWithTheSceneToWithinTheirSigma) {
  const Accuracy found = accuracy(swept_sideways().frames, TrackScene());
  EXPECT_EQ(swept_sideways().frames.size(), sideways().size());
  EXPECT_GT(found.points, 1200U * sideways().size());
  EXPECT_GT(found.within_two_sigma, 0.95);
  EXPECT_GT(found.within_1_percent, 0.9);
  EXPECT_GT(found.within_5_percent, 0.98);
}

TEST(SweepPoints, MovingForwardGivesPointsButNoneNearTheFocusOfExpansion) {
  const TrackScene scene;
  const Swept swept = sweep(drive(scene, 6, {0.0, 0.0, 0.3}));
  const Accuracy found = accuracy(swept.frames, scene);
  EXPECT_GT(found.points, 3000U);
  EXPECT_GT(found.within_two_sigma, 0.9);
  EXPECT_GT(found.within_5_percent, 0.97);
  for (const PointFrame& frame : swept.frames) {
    for (const LabeledPoint& point : frame.points) {
      const Eigen::Vector2d pixel = kCamera.project(point.position.cast<double>());
      EXPECT_GT((pixel - Eigen::Vector2d(159.5, 119.5)).norm(), 12.0);
      EXPECT_LE(point.sigma, 0.05 * point.position.norm() + 1e-6);
    }
  }
}

/// A floor alone, seen at a slant.
TrackScene floor_only() {
  TrackScene scene;
  scene.walls = {{{-40.0, -30.0, 18.0}, {80.0, 60.0}}};
  scene.floor_y = 1.2;
  return scene;
}

TEST(SweepPoints, TheFloorsDirectionIsLearntAndMakesTheFloorBetter) {
  const std::vector<TrackPicture> pictures = drive(floor_only(), 5, {0.3, 0.0, 0.0});
  const Swept along_floor = sweep(pictures);
  SweepConfig facing_only = near_scene();
  facing_only.max_directions = 0;
  const Swept facing = sweep(pictures, facing_only);
  EXPECT_GE(along_floor.last.directions, 1U);
  EXPECT_EQ(facing.last.directions, 0U);
  EXPECT_GT(along_floor.last.planes, facing.last.planes);
  const Accuracy with = accuracy(along_floor.frames, floor_only());
  const Accuracy without = accuracy(facing.frames, floor_only());
  EXPECT_GT(with.of_class.at(test::kFloor), without.of_class.at(test::kFloor));
  EXPECT_GT(with.within_1_percent, 0.9);
}

TEST(SweepPoints, WhatIsHiddenFromOneSideIsFoundFromTheOther) {
  // To the right of the wall in front lies a strip that the images before do not see.
  const PointFrame& frame = swept_sideways().frames[2];
  const View view{kCamera, frame.world_from_sensor};
  const double edge = kCamera.project(view.cam_from_world() * Eigen::Vector3d(-1.5, 0.0, 6.0)).x();
  std::size_t behind = 0;
  std::size_t wrong = 0;
  for (const LabeledPoint& point : frame.points) {
    const Eigen::Vector2d pixel = kCamera.project(point.position.cast<double>());
    if (pixel.x() > edge + 3.0 && pixel.x() < edge + 12.0 && pixel.y() < 160.0) {
      const bool is_behind = std::abs(point.position.z() - 9.0) < 0.3;
      behind += is_behind ? 1 : 0;
      wrong += is_behind ? 0 : 1;
    }
  }
  EXPECT_GT(behind, 20U);
  EXPECT_LT(wrong, behind / 5);
}

TEST(SweepPoints, StandingStillGivesNoPointsAndSaysSo) {
  const Swept swept = sweep(drive(TrackScene(), 4, Eigen::Vector3d::Zero()));
  EXPECT_EQ(swept.points(), 0U);
  EXPECT_TRUE(swept.reports[0].used);
  for (std::size_t k = 1; k < swept.reports.size(); ++k) {
    EXPECT_TRUE(swept.reports[k].still);
    EXPECT_FALSE(swept.reports[k].used);
  }
  EXPECT_EQ(swept.last.alone, 1U);
}

TEST(SweepPoints, TurningOnTheSpotIsNoMotion) {
  std::vector<TrackPicture> pictures;
  pictures.reserve(4);
  for (int k = 0; k < 4; ++k) {
    pictures.push_back(
        test::take_picture(TrackScene(), test::track_view(Eigen::Vector3d::Zero(), 0.05 * k)));
  }
  const Swept swept = sweep(pictures);
  EXPECT_EQ(swept.points(), 0U);
  EXPECT_TRUE(swept.reports.back().still);
}

TEST(SweepPoints, ImagesWithoutMotionInBetweenChangeNothing) {
  std::vector<TrackPicture> pictures = sideways();
  pictures.insert(pictures.begin() + 3, pictures[2]);
  const Swept swept = sweep(pictures);
  EXPECT_TRUE(swept.reports[3].still);
  EXPECT_EQ(swept.points(), swept_sideways().points());
}

TEST(SweepPoints, AJumpOfTheExposureLosesFewPoints) {
  std::vector<TrackPicture> pictures = sideways();
  for (std::size_t k = 3; k < pictures.size(); ++k) {
    cv::Mat darker;
    pictures[k].gray.convertTo(darker, CV_8U, 0.5, 25.0);
    pictures[k].gray = darker;
  }
  const Swept swept = sweep(pictures);
  const Accuracy found = accuracy(swept.frames, TrackScene());
  EXPECT_GT(static_cast<double>(swept.points()),
            0.8 * static_cast<double>(swept_sideways().points()));
  EXPECT_GT(found.within_two_sigma, 0.93);
  EXPECT_GT(found.within_5_percent, 0.97);
}

TEST(SweepPoints, MovingThingsGiveFewPoints) {
  std::vector<TrackPicture> pictures;
  for (int k = 0; k < 6; ++k) {
    TrackScene scene;
    scene.walls.push_back(
        {{0.5, -1.5, 5.0}, {2.5, 2.0}, test::kMover, Eigen::Vector3d(0.05, 0.15, 0.0) * k});
    pictures.push_back(test::take_picture(scene, test::track_view({0.25 * k, 0.0, 0.0})));
  }
  Accuracy found = accuracy(sweep(pictures).frames, TrackScene());
  EXPECT_GT(found.of_class[test::kWall], 2000U);
  EXPECT_LT(found.of_class[test::kMover], found.of_class[test::kWall] / 20);
}

TEST(SweepPoints, FramesComeOutInOrderWithTheirPosesTwiceTheWindowLater) {
  SweepConfig config = near_scene();
  config.window = 2;
  PlaneSweeper sweeper(config);
  for (std::size_t k = 0; k < sideways().size(); ++k) {
    const TrackPicture& picture = sideways()[k];
    const auto frames = sweeper.add(picture.gray, picture.view, {}, static_cast<double>(k));
    ASSERT_EQ(frames.size(), k >= 4 ? 1U : 0U);
    if (k >= 4) {
      EXPECT_EQ(frames[0].stamp, static_cast<double>(k - 4));
      EXPECT_TRUE(frames[0].world_from_sensor.isApprox(sideways()[k - 4].view.world_from_cam));
      EXPECT_EQ(frames[0].points[0].label, kUnlabelled);
    }
  }
  EXPECT_EQ(sweeper.finish().size(), 4U);
  EXPECT_TRUE(sweeper.finish().empty());
}

TEST(SweepPoints, EqualInputGivesEqualPoints) {
  const Swept again = sweep(sideways());
  const std::vector<PointFrame>& first = swept_sideways().frames;
  ASSERT_EQ(first.size(), again.frames.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    ASSERT_EQ(first[k].points.size(), again.frames[k].points.size());
    for (std::size_t n = 0; n < first[k].points.size(); ++n) {
      EXPECT_EQ(first[k].points[n].position, again.frames[k].points[n].position);
      EXPECT_EQ(first[k].points[n].sigma, again.frames[k].points[n].sigma);
    }
  }
}

TEST(SweepPoints, PointsHaveTheClassOfTheirPixelAndExcludedOnesGiveNone) {
  SweepConfig config = near_scene();
  config.excluded_labels = {test::kFloor};
  const std::vector<TrackPicture> pictures(sideways().begin(), sideways().begin() + 4);
  for (const PointFrame& frame : sweep(pictures, config).frames) {
    const View view{kCamera, frame.world_from_sensor};
    for (const LabeledPoint& point : frame.points) {
      EXPECT_NE(point.label, test::kFloor);
      const Eigen::Vector2d pixel = kCamera.project(point.position.cast<double>());
      EXPECT_EQ(
          point.label,
          test::hit_from(TrackScene(), view, {std::round(pixel.x()), std::round(pixel.y())}).label);
    }
  }
}

TEST(SweepPoints, AtMostOnePointPerCell) {
  std::map<std::pair<int, int>, int> cells;
  for (const LabeledPoint& point : swept_sideways().frames[2].points) {
    const Eigen::Vector2d pixel = kCamera.project(point.position.cast<double>());
    const int count = ++cells[{static_cast<int>(std::lround(pixel.x())) / 5,
                               static_cast<int>(std::lround(pixel.y())) / 5}];
    EXPECT_LE(count, 2);  // one textured and one of the larger flat cells
  }
}

TEST(SweepPoints, ABrokenPoseIsLeftOutAndSaid) {
  std::vector<TrackPicture> pictures = sideways();
  pictures[3].view.world_from_cam.translation().x() = std::numeric_limits<double>::quiet_NaN();
  const Swept swept = sweep(pictures);
  EXPECT_TRUE(swept.reports[3].bad_pose);
  EXPECT_FALSE(swept.reports[3].used);
  EXPECT_FALSE(swept.reports[4].restarted);
  EXPECT_EQ(swept.frames.size(), sideways().size() - 1);
  EXPECT_GT(accuracy(swept.frames, TrackScene()).within_5_percent, 0.97);
}

TEST(SweepPoints, AJumpOfThePoseGivesNoWrongPoints) {
  std::vector<TrackPicture> pictures = sideways();
  for (std::size_t k = 3; k < pictures.size(); ++k) {
    pictures[k].view.world_from_cam.translation() += Eigen::Vector3d(0.0, 1.0, 0.0);
  }
  Swept swept = sweep(pictures);
  for (PointFrame& frame : swept.frames) {
    frame.world_from_sensor.translation().y() = 0.0;
  }
  const Accuracy found = accuracy(swept.frames, TrackScene());
  EXPECT_GT(found.points, 1000U);
  EXPECT_GT(found.within_5_percent, 0.95);
}

TEST(SweepPoints, AnotherSizeOrTimeGoingBackStartsAnewAndWhatWaitedComesOut) {
  PlaneSweeper sweeper(near_scene());
  for (int k = 0; k < 3; ++k) {
    const TrackPicture& picture = sideways()[static_cast<std::size_t>(k)];
    EXPECT_TRUE(sweeper.add(picture.gray, picture.view, picture.labels, k).empty());
  }
  SweepReport report;
  EXPECT_EQ(sweeper.add(sideways()[3].gray, sideways()[3].view, {}, 0.5, &report).size(), 3U);
  EXPECT_TRUE(report.restarted);
  EXPECT_TRUE(report.used);
  TrackPicture half = sideways()[4];
  half.view.camera = half.view.camera.resized(160, 240);
  EXPECT_TRUE(sweeper.add(half.gray.colRange(0, 160), half.view, {}, 1.0, &report).empty());
  EXPECT_TRUE(report.restarted);
  EXPECT_EQ(report.alone, 1U);
}

TEST(SweepPoints, LargeImagesAreSweptAtAPartOfTheirSize) {
  SweepConfig config = near_scene();
  config.sweep_width_px = 160;
  const std::vector<TrackPicture> pictures(sideways().begin(), sideways().begin() + 4);
  const Swept swept = sweep(pictures, config);
  EXPECT_EQ(swept.last.pixels, 4U * 160U * 120U);
  const Accuracy found = accuracy(swept.frames, TrackScene());
  EXPECT_GT(found.points, 2000U);
  EXPECT_GT(found.within_1_percent, 0.85);
}

TEST(SweepPoints, AGreyImageIsUsedAndGivesNothing) {
  std::vector<TrackPicture> pictures(sideways().begin(), sideways().begin() + 3);
  for (TrackPicture& picture : pictures) {
    picture.gray = cv::Mat(picture.gray.size(), CV_8UC1, cv::Scalar(90));
  }
  const Swept swept = sweep(pictures);
  EXPECT_TRUE(swept.reports[2].used);
  EXPECT_EQ(swept.points(), 0U);
}

TEST(SweepPoints, TinyImagesAreNoTrouble) {
  std::vector<TrackPicture> pictures(sideways().begin(), sideways().begin() + 3);
  for (TrackPicture& picture : pictures) {
    picture.view.camera.width = 3;
    picture.view.camera.height = 1;
    picture.gray = picture.gray(cv::Rect(0, 0, 3, 1)).clone();
    picture.labels = cv::Mat();
  }
  EXPECT_EQ(sweep(pictures).points(), 0U);
}

TEST(SweepPoints, WhatDoesNotFitIsRefused) {
  SweepConfig config;
  config.window = 0;
  EXPECT_THROW(PlaneSweeper{config}, std::invalid_argument);
  config = {};
  config.max_depth_m = std::numeric_limits<double>::infinity();
  EXPECT_THROW(PlaneSweeper{config}, std::invalid_argument);
  PlaneSweeper sweeper;
  const TrackPicture& picture = sideways()[0];
  EXPECT_THROW(sweeper.add({}, picture.view, {}, 0.0), std::invalid_argument);
  EXPECT_THROW(sweeper.add(picture.gray.rowRange(0, 100), picture.view, {}, 0.0),
               std::invalid_argument);
  EXPECT_THROW(sweeper.add(picture.gray, picture.view, picture.gray, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
