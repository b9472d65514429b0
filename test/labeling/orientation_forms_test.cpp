// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The forms of the orientation prior within the whole labelling.
#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>

#include "labeled_scene.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

constexpr Label kHouse = 11;
constexpr Label kBush = 12;

LabelingConfig with_form(OrientationPrior form) {
  LabelingConfig config;
  config.orientation_prior = form;
  return config;
}

/// The upper half of the house's right wall.
bool is_disputed(const TriangleMesh& mesh, int f) {
  return facet_cross(mesh, f).normalized().x() > 0.9 &&
         mesh.vertices[mesh.triangles[f][0]].z() > 0.0;
}

/// A house with walls to six sides and a round bush beside it. Every other image of the disputed
/// part takes it for bush.
test::LabeledScene disputed_house() {
  test::LabeledScene scene;
  const TriangleMesh house = test::make_box({2.0, 2.0, 2.0}, 4);
  Eigen::Isometry3d beside = Eigen::Isometry3d::Identity();
  beside.translation().y() = 3.5;
  scene.mesh = test::joined(house, test::transformed(test::make_uv_sphere(1.0, 16, 24), beside));
  scene.truth.assign(scene.mesh.triangles.size(), kBush);
  std::fill_n(scene.truth.begin(), house.triangles.size(), kHouse);
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d eye(
        (k & 1) != 0 ? 6.0 : -6.0, (k & 2) != 0 ? 7.0 : -6.0, (k & 4) != 0 ? 5.0 : -5.0);
    test::add_view(&scene, test::look_at(test::make_camera(200, 160, 150.0), eye, {0.0, 1.5, 0.0}));
  }
  for (const std::size_t k : {1, 7}) {
    cv::Mat& labels = scene.views[k].labels;
    for (int p = 0; p < static_cast<int>(labels.total()); ++p) {
      const int f = scene.renderings[k].facets.at<int>(p / labels.cols, p % labels.cols);
      if (f >= 0 && scene.truth[f] == kHouse && is_disputed(scene.mesh, f)) {
        labels.at<Label>(p / labels.cols, p % labels.cols) = kBush;
      }
    }
  }
  return scene;
}

TEST(OrientationForms, AMixtureDecidesForAHouseWhoseWallsLookManyWays) {
  const test::LabeledScene scene = disputed_house();
  const auto accuracy = [&](OrientationPrior form) {
    LabelingConfig config = with_form(form);
    config.smooth_equal = config.smooth_different;
    return test::facet_accuracy(scene, test::label(scene, config).labels);
  };
  EXPECT_LT(accuracy(OrientationPrior::kGlobal), 0.9);
  EXPECT_GT(accuracy(OrientationPrior::kMixture), 0.96);
}

class EveryForm : public testing::TestWithParam<OrientationPrior> {};

INSTANTIATE_TEST_SUITE_P(Forms,
                         EveryForm,
                         testing::Values(OrientationPrior::kGlobal,
                                         OrientationPrior::kMixture,
                                         OrientationPrior::kLocal));

TEST_P(EveryForm, CleansNoisySegmentations) {
  test::LabeledScene scene = test::make_box_scene();
  test::add_noise(&scene, 0.35, 7, 3);
  LabelingConfig config = with_form(GetParam());
  config.local_facets = 300;
  const LabelingResult result = test::label(scene, config);
  EXPECT_GT(test::facet_accuracy(scene, result.labels), 0.98);
  EXPECT_LT(test::input_accuracy(scene), 0.8);
  EXPECT_LT(result.energy_after, result.energy_before);
  EXPECT_EQ(test::label(scene, config).labels, result.labels);
}

TEST_P(EveryForm, NumberingOfTheClassesDoesNotMatter) {
  test::LabeledScene scene = test::make_box_scene();
  test::add_noise(&scene, 0.4, 7, 11);
  LabelingConfig config = with_form(GetParam());
  config.local_facets = 300;
  const LabelingResult expected = test::label(scene, config);
  const std::map<Label, Label> renumbered{
      {10, 900}, {11, 3}, {12, 12}, {13, 700}, {14, 0}, {15, 11}, {kUnlabelled, kUnlabelled}};
  for (LabeledView& view : scene.views) {
    std::for_each(view.labels.begin<Label>(), view.labels.end<Label>(), [&](Label& label) {
      label = renumbered.at(label);
    });
  }
  const LabelingResult result = test::label(scene, config);
  for (std::size_t f = 0; f < result.labels.size(); ++f) {
    ASSERT_EQ(result.labels[f], renumbered.at(expected.labels[f]));
  }
}

TEST(OrientationForms, EmptyNeighbourhoodsAreRefused) {
  LabelingConfig config;
  config.local_facets = 0;
  EXPECT_THROW(test::label(test::make_box_scene(1), config), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
