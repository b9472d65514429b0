// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/labeling/facet_labeling.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <vector>

#include "labeled_scene.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

LabelingConfig without_smoothing() {
  LabelingConfig config;
  config.smooth_equal = 0.5;
  config.smooth_different = 0.5;
  return config;
}

TEST(FacetLabeling, TrueSegmentationsGiveTheTrueLabels) {
  const test::LabeledScene scene = test::make_box_scene();
  const LabelingResult result = test::label(scene);
  EXPECT_GT(test::facet_accuracy(scene, result.labels), 0.995);
  EXPECT_EQ(result.changed, scene.mesh.triangles.size());
  EXPECT_GT(*std::min_element(result.views.begin(), result.views.end()), 0);
}

TEST(FacetLabeling, CleansNoisySegmentationsOfABox) {
  test::LabeledScene scene = test::make_box_scene();
  test::add_noise(&scene, 0.35, 7, 3);
  LabelingConfig none = without_smoothing();
  none.normal_weight = 0.0;
  const double input = test::input_accuracy(scene);
  const double data_only = test::facet_accuracy(scene, test::label(scene, none).labels);
  const double result = test::facet_accuracy(scene, test::label(scene).labels);
  EXPECT_LT(input, 0.8);
  EXPECT_GT(data_only, input);
  EXPECT_GT(result, data_only);
  EXPECT_GT(result, 0.98);
}

TEST(FacetLabeling, CleansNoisySegmentationsOfAPlane) {
  test::LabeledScene scene;
  scene.mesh = test::make_grid_plane(40, 40, 0.25);
  for (std::size_t f = 0; f < scene.mesh.triangles.size(); ++f) {
    const double y = scene.mesh.vertices[scene.mesh.triangles[f][0]].y();
    scene.truth.push_back(y < -2.5 ? 10 : y < 2.5 ? 11 : 12);
  }
  for (const double x : {-3.0, 0.0, 3.0}) {
    test::add_view(&scene,
                   test::look_at(test::make_camera(240, 200, 150.0), {x, -9, 5}, {0, 0, 0}));
  }
  test::add_noise(&scene, 0.3, 9, 5);
  const LabelingResult result = test::label(scene);
  EXPECT_LT(test::input_accuracy(scene), 0.82);
  EXPECT_GT(test::facet_accuracy(scene, result.labels), 0.95);
}

TEST(FacetLabeling, EnergyNeverRises) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    test::LabeledScene scene = test::make_box_scene(3);
    test::add_noise(&scene, 0.5, 6, seed);
    const LabelingResult result = test::label(scene);
    EXPECT_LT(result.energy_after, result.energy_before);
    LabelingConfig still;
    still.max_sweeps = 0;
    EXPECT_EQ(test::label(scene, still).energy_after, result.energy_before);
  }
}

TEST(FacetLabeling, SameInputSameOutput) {
  test::LabeledScene scene = test::make_box_scene();
  test::add_noise(&scene, 0.4, 7, 9);
  const LabelingResult first = test::label(scene);
  const LabelingResult second = test::label(scene);
  EXPECT_EQ(first.labels, second.labels);
  EXPECT_EQ(first.confidence, second.confidence);
  EXPECT_EQ(first.energy_after, second.energy_after);
}

TEST(FacetLabeling, NumberingOfTheClassesDoesNotMatter) {
  test::LabeledScene scene = test::make_box_scene();
  test::add_noise(&scene, 0.4, 7, 11);
  const LabelingResult expected = test::label(scene);
  const std::map<Label, Label> renumbered{
      {10, 900}, {11, 3}, {12, 12}, {13, 700}, {14, 0}, {15, 11}, {kUnlabelled, kUnlabelled}};
  for (LabeledView& view : scene.views) {
    std::for_each(view.labels.begin<Label>(), view.labels.end<Label>(), [&](Label& label) {
      label = renumbered.at(label);
    });
  }
  const LabelingResult result = test::label(scene);
  for (std::size_t f = 0; f < result.labels.size(); ++f) {
    ASSERT_EQ(result.labels[f], renumbered.at(expected.labels[f]));
  }
  EXPECT_EQ(result.confidence, expected.confidence);
}

TEST(FacetLabeling, ConfidenceIsHighWhereImagesAgreeAndLowAtDisputes) {
  test::LabeledScene scene = test::make_box_scene(3);
  const LabelingResult agreed = test::label(scene);
  // Half of the images now say another class for the face +z (label 15).
  for (std::size_t k = 0; k < scene.views.size(); k += 2) {
    scene.views[k].labels.setTo(14, scene.views[k].labels == 15);
  }
  const LabelingResult disputed = test::label(scene);
  const std::size_t per_face = scene.mesh.triangles.size() / 6;
  double before = 0.0;
  double after = 0.0;
  for (std::size_t f = 0; f < scene.truth.size(); ++f) {
    EXPECT_GE(agreed.confidence[f], 0.0F);
    EXPECT_LE(agreed.confidence[f], 1.0F);
    if (scene.truth[f] == 15) {
      before += agreed.confidence[f] / static_cast<double>(per_face);
      after += disputed.confidence[f] / static_cast<double>(per_face);
    }
  }
  EXPECT_GT(before, 0.95);
  EXPECT_LT(after, before - 0.005);
}

TEST(FacetLabeling, VoidDoesNotSeeAndExcludedLabelsSupportNothing) {
  test::LabeledScene scene = test::make_box_scene(4);
  for (LabeledView& view : scene.views) {
    view.labels.setTo(kUnlabelled, view.labels == 15);
  }
  LabelingConfig config;
  config.excluded = {14};
  const LabelingResult result = test::label(scene, config);
  std::size_t unseen = 0;
  std::size_t seen = 0;
  for (std::size_t f = 0; f < result.labels.size(); ++f) {
    EXPECT_LT(result.labels[f], 14);
    unseen += scene.truth[f] == 15 && result.views[f] == 0 ? 1 : 0;
    seen += scene.truth[f] == 14 && result.views[f] > 0 ? 1 : 0;
    if (scene.truth[f] < 14) {
      EXPECT_EQ(result.labels[f], scene.truth[f]);
    }
  }
  const double per_face = static_cast<double>(scene.truth.size()) / 6.0;
  EXPECT_GT(static_cast<double>(unseen), 0.7 * per_face);
  EXPECT_EQ(static_cast<double>(seen), per_face);
  EXPECT_GT(std::count(result.confidence.begin(), result.confidence.end(), 0.0F), per_face);
}

TEST(FacetLabeling, AFewOddPixelsBeforeTheSkyDoNotLabelAFacet) {
  test::LabeledScene scene;
  scene.mesh = test::make_grid_plane(6, 6, 1.0);
  for (std::size_t f = 0; f < scene.mesh.triangles.size(); ++f) {
    scene.truth.push_back(f < 48 ? 10 : 14);
  }
  test::add_view(&scene, test::look_at(test::make_camera(200, 200, 190.0), {0, 0, 7}, {0, 0, 0}));
  cv::Mat& labels = scene.views[0].labels;
  for (int y = 5; y < labels.rows; y += 9) {
    for (int x = 5; x < labels.cols; x += 9) {
      labels.at<Label>(y, x) = labels.at<Label>(y, x) == 14 ? 11 : labels.at<Label>(y, x);
    }
  }
  LabelingConfig config;
  config.excluded = {14};
  const LabelingResult result = test::label(scene, config);
  EXPECT_EQ(std::count(result.labels.begin(), result.labels.end(), 10), 72);
}

/// Two separate planes, of which the cameras see only the first.
test::LabeledScene seen_and_unseen_plane() {
  test::LabeledScene scene;
  const TriangleMesh plane = test::make_grid_plane(8, 8, 0.5);
  Eigen::Isometry3d away = Eigen::Isometry3d::Identity();
  away.translation().x() = 100.0;
  scene.mesh = test::joined(plane, test::transformed(plane, away));
  scene.truth.assign(scene.mesh.triangles.size(), 10);
  test::add_view(&scene, test::look_at(test::make_camera(100, 100, 80.0), {0, -3, 5}, {0, 0, 0}));
  return scene;
}

TEST(FacetLabeling, PartsWithoutAnyEvidenceStayUnlabelled) {
  const test::LabeledScene scene = seen_and_unseen_plane();
  const LabelingResult result = test::label(scene);
  const std::size_t half = result.labels.size() / 2;
  for (std::size_t f = 0; f < half; ++f) {
    EXPECT_EQ(result.labels[f], 10);
    EXPECT_EQ(result.views[f], 1);
    EXPECT_EQ(result.labels[half + f], kUnlabelled);
    EXPECT_EQ(result.confidence[half + f], 0.0F);
    EXPECT_EQ(result.views[half + f], 0);
  }
}

TEST(FacetLabeling, UnseenPartsKeepTheirOwnLabelsButSingleOddOnesAreSmoothed) {
  test::LabeledScene scene = seen_and_unseen_plane();
  const std::size_t half = scene.mesh.triangles.size() / 2;
  scene.mesh.labels.assign(2 * half, kUnlabelled);
  std::fill(scene.mesh.labels.begin() + static_cast<std::ptrdiff_t>(half),
            scene.mesh.labels.end(),
            Label{3});
  scene.mesh.labels[half + 51] = 4;
  scene.mesh.labels[half + 70] = kUnlabelled;
  const LabelingResult result = test::label(scene);
  EXPECT_EQ(result.labels[0], 10);
  for (std::size_t f = half; f < 2 * half; ++f) {
    EXPECT_EQ(result.labels[f], 3);
  }
  EXPECT_EQ(result.changed, half + 2);
}

TEST(FacetLabeling, GapsTakeNoPartAndStayGaps) {
  test::LabeledScene scene = test::make_box_scene(3);
  const std::size_t per_face = scene.mesh.triangles.size() / 6;
  scene.mesh.views.assign(6 * per_face, 1);
  // The second face closes space that nobody saw; the facets after it keep their own numbers.
  std::fill_n(
      scene.mesh.views.begin() + static_cast<std::ptrdiff_t>(per_face), per_face, std::uint16_t{0});
  const LabelingResult result = test::label(scene);
  TriangleMesh labelled = scene.mesh;
  apply_labeling(result, &labelled);
  for (std::size_t f = 0; f < result.labels.size(); ++f) {
    const bool gap = f / per_face == 1;
    EXPECT_EQ(result.labels[f], gap ? kUnlabelled : scene.truth[f]);
    EXPECT_EQ(is_gap(labelled, f), gap);
  }
}

TEST(FacetLabeling, ImagesOverruleTheMeshesOwnLabels) {
  test::LabeledScene scene = test::make_box_scene(3);
  scene.mesh.labels.assign(scene.mesh.triangles.size(), 77);
  const LabelingResult result = test::label(scene);
  EXPECT_EQ(std::count(result.labels.begin(), result.labels.end(), 77), 0);
}

TEST(FacetLabeling, OrientationDecidesWhereImagesDisagree) {
  // Floor (10) and wall (11). One of two images takes the right half of the wall for floor.
  test::LabeledScene scene;
  Eigen::Isometry3d upright = Eigen::Isometry3d::Identity();
  upright.linear() = Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitX()).matrix();
  upright.translation() = Eigen::Vector3d(0.0, 2.0, 2.0);
  const TriangleMesh floor = test::make_grid_plane(16, 16, 0.25);
  scene.mesh = test::joined(floor, test::transformed(floor, upright));
  for (std::size_t f = 0; f < scene.mesh.triangles.size(); ++f) {
    scene.truth.push_back(f < floor.triangles.size() ? 10 : 11);
  }
  for (const double x : {-1.0, 1.0}) {
    test::add_view(&scene,
                   test::look_at(test::make_camera(200, 200, 150.0), {x, -6, 5}, {0, 1.0, 0.5}));
  }
  cv::Mat& labels = scene.views[0].labels;
  cv::Mat right_half = labels.colRange(labels.cols / 2, labels.cols);
  right_half.setTo(10, right_half == 11);
  LabelingConfig config = without_smoothing();
  config.normal_weight = 0.0;
  const double without = test::facet_accuracy(scene, test::label(scene, config).labels);
  config.normal_weight = 1.5;
  const double with = test::facet_accuracy(scene, test::label(scene, config).labels);
  EXPECT_LT(without, 0.92);
  EXPECT_GT(with, 0.97);
}

TEST(FacetLabeling, PixelsOverruleVerticesOnLargeFacets) {
  test::LabeledScene scene;
  scene.mesh = test::make_grid_plane(4, 4, 1.0);
  scene.truth.assign(scene.mesh.triangles.size(), 10);
  test::add_view(&scene, test::look_at(test::make_camera(200, 200, 190.0), {0, 0, 5}, {0, 0, 0}));
  // Around every vertex the segmentation is wrong, as it often is at corners and borders.
  const View& view = scene.views[0].view;
  for (const Eigen::Vector3d& vertex : scene.mesh.vertices) {
    const Eigen::Vector2d p = view.camera.project(view.cam_from_world() * vertex);
    const cv::Rect around(static_cast<int>(p.x()) - 3, static_cast<int>(p.y()) - 3, 7, 7);
    cv::Mat& labels = scene.views[0].labels;
    labels(around & cv::Rect({0, 0}, labels.size())).setTo(11);
  }
  LabelingConfig config;
  EXPECT_EQ(test::facet_accuracy(scene, test::label(scene, config).labels), 1.0);
  config.pixel_votes = false;
  EXPECT_EQ(test::facet_accuracy(scene, test::label(scene, config).labels), 0.0);
}

TEST(FacetLabeling, NothingToGoByMeansNothingSaid) {
  test::LabeledScene scene = test::make_box_scene(1);
  for (LabeledView& view : scene.views) {
    view.labels.release();
  }
  const LabelingResult result = test::label(scene);
  EXPECT_EQ(std::count(result.labels.begin(), result.labels.end(), kUnlabelled),
            static_cast<std::ptrdiff_t>(result.labels.size()));
  EXPECT_EQ(label_facets({}, {}, {}, {}).labels.size(), 0U);
}

TEST(FacetLabeling, InvalidInputIsRefused) {
  const test::LabeledScene good = test::make_box_scene(1);
  test::LabeledScene scene = good;
  scene.renderings.pop_back();
  EXPECT_THROW(test::label(scene), std::invalid_argument);
  scene = good;
  scene.views[2].labels = cv::Mat(5, 5, CV_16UC1, cv::Scalar(1));
  EXPECT_THROW(test::label(scene), std::invalid_argument);
  scene = good;
  scene.renderings[1].depth = cv::Mat();
  EXPECT_THROW(test::label(scene), std::invalid_argument);
  scene = good;
  scene.mesh.labels = {1, 2, 3};
  EXPECT_THROW(test::label(scene), std::invalid_argument);
  LabelingConfig config;
  config.beta = 0.0;
  EXPECT_THROW(test::label(good, config), std::invalid_argument);
  scene = good;
  scene.renderings[3].facets.at<std::int32_t>(0, 0) = 100000;
  EXPECT_THROW(test::label(scene), std::invalid_argument);
  config = LabelingConfig();
  config.smooth_different = 0.9;
  EXPECT_THROW(test::label(good, config), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
