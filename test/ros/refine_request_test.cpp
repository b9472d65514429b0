// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/refine_request.h"

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "support/meshes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

RefinementConfig node_defaults() {
  RefinementConfig config;
  config.iterations = 7;
  config.levels = 3;
  config.photometric = false;
  config.semantic = SemanticMode::kFull;
  config.semantic_weight = 0.5;
  config.smoothing = 0.3;
  config.thin_plate = 0.4;
  return config;
}

TEST(RefineRequest, EmptyRequestMeansTheNodesParameters) {
  const RefinementConfig config = refinement_config(Refine::Request(), node_defaults());
  EXPECT_EQ(config.iterations, 7);
  EXPECT_EQ(config.levels, 3);
  EXPECT_FALSE(config.photometric);
  EXPECT_EQ(config.semantic, SemanticMode::kFull);
  EXPECT_EQ(config.semantic_weight, 0.5);
  EXPECT_EQ(config.smoothing, 0.3);
  EXPECT_EQ(config.thin_plate, 0.4);
}

TEST(RefineRequest, WhatIsGivenCounts) {
  Refine::Request request;
  request.iterations = 2;
  request.levels = 1;
  request.photometric = Refine::Request::ON;
  request.semantic_mode = Refine::Request::SEMANTIC_OFF;
  request.custom_weights = 1;
  request.semantic_weight = 0.0;
  request.smoothing = -1.0;
  request.thin_plate = 0.1;
  const RefinementConfig config = refinement_config(request, node_defaults());
  EXPECT_EQ(config.iterations, 2);
  EXPECT_EQ(config.levels, 1);
  EXPECT_TRUE(config.photometric);
  EXPECT_EQ(config.semantic, SemanticMode::kOff);
  EXPECT_EQ(config.semantic_weight, 0.0);
  EXPECT_EQ(config.smoothing, 0.3);
  EXPECT_EQ(config.thin_plate, 0.1);
}

TEST(RefineRequest, EverySemanticModeCanBeAskedFor) {
  using Request = Refine::Request;
  const std::vector<std::pair<std::uint8_t, SemanticMode>> modes = {
      {Request::SEMANTIC_OFF, SemanticMode::kOff},
      {Request::SEMANTIC_NORMAL, SemanticMode::kNormal},
      {Request::SEMANTIC_FULL, SemanticMode::kFull},
      {Request::SEMANTIC_PAIRWISE, SemanticMode::kPairwise},
      {Request::SEMANTIC_SPLIT, SemanticMode::kSplit}};
  for (const auto& [asked, mode] : modes) {
    Request request;
    request.semantic_mode = asked;
    EXPECT_EQ(refinement_config(request, node_defaults()).semantic, mode);
  }
}

template <typename Change>
void expect_refused(const Change& change) {
  Refine::Request request;
  change(request);
  EXPECT_THROW(refinement_config(request, node_defaults()), std::invalid_argument);
}

TEST(RefineRequest, APartCanBeAskedFor) {
  Refine::Request request;
  EXPECT_TRUE(refinement_config(request, node_defaults()).part.is_everything());
  request.region.max.x = 5.0;
  request.classes.push_back(3);
  const Eigen::Isometry3d moved(Eigen::Translation3d(1.0, 2.0, 3.0));
  const MeshPart part = refinement_config(request, node_defaults(), moved).part;
  EXPECT_EQ(part.box.max(), Eigen::Vector3d(5.0, 0.0, 0.0));
  EXPECT_TRUE(part.box_from_mesh.isApprox(moved));
  EXPECT_EQ(part.classes, std::vector<Label>{3});
}

TEST(RefineRequest, WhatIsOutOfRangeIsRefused) {
  expect_refused([](auto& request) { request.iterations = -1; });
  expect_refused([](auto& request) { request.region.max.x = -5.0; });
  expect_refused([](auto& request) { request.levels = 50; });
  expect_refused([](auto& request) { request.photometric = 3; });
  expect_refused([](auto& request) { request.semantic_mode = 6; });
  expect_refused([](auto& request) { request.time_budget = -1.0; });
  expect_refused(
      [](auto& request) { request.memory_budget = std::numeric_limits<double>::quiet_NaN(); });
  expect_refused([](auto& request) {
    request.custom_weights = 1;
    request.smoothing = 1.5;
  });
}

TEST(RefineRequest, MemoryEstimateGrowsWithViewsAndFacets) {
  LabeledView view;
  view.gray = cv::Mat(375, 1242, CV_8UC1);
  const TriangleMesh small = test::make_grid_plane(10, 10, 1.0);
  const TriangleMesh big = test::make_grid_plane(500, 500, 1.0);
  const RefinementConfig config;
  const double one = estimate_refine_mib(small, {view}, config);
  EXPECT_GT(one, 5.0);
  EXPECT_GT(estimate_refine_mib(small, {view, view}, config), 1.9 * one);
  EXPECT_GT(estimate_refine_mib(big, {view}, config), 100.0 + one);
}

}  // namespace
}  // namespace facet_mapping
