// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/refine_settings.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using Request = Refine::Request;

ClassStyle style(Label id, const std::string& name) {
  ClassStyle style;
  style.id = id;
  style.name = name;
  return style;
}

const std::vector<ClassStyle> kKnown = {
    style(kUnlabelled, "unlabelled"), style(7, "road"), style(26, "car"), style(30, "5")};

std::string message_of(const RefineSettings& settings) {
  try {
    refine_request(settings, kKnown, std::nullopt);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RefineSettings, WhatIsNotChosenIsLeftToTheNode) {
  const Request request = refine_request({}, kKnown, std::nullopt);
  Request everything_default;
  everything_default.semantic_weight = request.semantic_weight;
  everything_default.smoothing = request.smoothing;
  everything_default.thin_plate = request.thin_plate;
  EXPECT_EQ(request, everything_default);
  EXPECT_EQ(request.custom_weights, 0);
  EXPECT_EQ(request.start, Request::START_MAP);
  EXPECT_TRUE(request.region.frame_id.empty());
}

TEST(RefineSettings, AllThatCanBeChosenIsSent) {
  RefineSettings settings;
  settings.visible_region = true;
  settings.classes = "car, road";
  settings.start = Request::START_REFINED;
  settings.photometric = Request::OFF;
  settings.semantic_mode = Request::SEMANTIC_SPLIT;
  settings.levels = "3";
  settings.iterations = " 12 ";
  settings.semantic_weight = "0.5";
  settings.smoothing = "0";
  settings.thin_plate = "1e-2";
  settings.time_budget = "20.5";
  const BoxRegion box = region_around({Eigen::Vector3d(-1, -2, -3), Eigen::Vector3d(4, 5, 6)}, "m");
  const Request request = refine_request(settings, kKnown, box);
  EXPECT_EQ(request.region, box);
  EXPECT_EQ(request.classes, (std::vector<std::uint16_t>{26, 7}));
  EXPECT_EQ(request.start, Request::START_REFINED);
  EXPECT_EQ(request.photometric, Request::OFF);
  EXPECT_EQ(request.semantic_mode, Request::SEMANTIC_SPLIT);
  EXPECT_EQ(request.levels, 3);
  EXPECT_EQ(request.iterations, 12);
  EXPECT_EQ(request.custom_weights, 1);
  EXPECT_DOUBLE_EQ(request.semantic_weight, 0.5);
  EXPECT_DOUBLE_EQ(request.smoothing, 0.0);
  EXPECT_DOUBLE_EQ(request.thin_plate, 0.01);
  EXPECT_DOUBLE_EQ(request.time_budget, 20.5);
}

TEST(RefineSettings, OneWeightAloneLeavesTheOthersToTheNode) {
  RefineSettings settings;
  settings.smoothing = "0.2";
  const Request request = refine_request(settings, kKnown, std::nullopt);
  EXPECT_EQ(request.custom_weights, 1);
  EXPECT_DOUBLE_EQ(request.smoothing, 0.2);
  EXPECT_LT(request.semantic_weight, 0.0);
  EXPECT_LT(request.thin_plate, 0.0);
}

TEST(RefineSettings, WhatIsNoNumberIsSaidWithItsField) {
  RefineSettings settings;
  settings.levels = "two";
  EXPECT_NE(message_of(settings).find("Levels: 'two'"), std::string::npos);
  settings = {};
  settings.iterations = "0";
  EXPECT_NE(message_of(settings).find("Iterations: '0'"), std::string::npos);
  settings = {};
  settings.smoothing = "0,5";
  EXPECT_NE(message_of(settings).find("Smoothing: '0,5'"), std::string::npos);
  for (const char* text : {"-1", "nan", "inf", "1e999", "1 2"}) {
    settings = {};
    settings.time_budget = text;
    EXPECT_NE(message_of(settings).find(text), std::string::npos) << text;
  }
}

TEST(RefineSettings, AnEmptyViewIsNotEverything) {
  RefineSettings settings;
  settings.visible_region = true;
  EXPECT_NE(message_of(settings).find("the view shows nothing"), std::string::npos);
}

TEST(RefineSettings, ClassesByNameOrId) {
  EXPECT_TRUE(parse_classes(" , ", kKnown).empty());
  EXPECT_EQ(parse_classes("road,road, 7 ,11", kKnown), (std::vector<std::uint16_t>{7, 11}));
  EXPECT_EQ(parse_classes("unlabelled", kKnown), (std::vector<std::uint16_t>{kUnlabelled}));
  EXPECT_EQ(parse_classes("5", kKnown), (std::vector<std::uint16_t>{30})) << "a name comes first";
  EXPECT_THROW(parse_classes("roda", kKnown), std::invalid_argument);
  EXPECT_THROW(parse_classes("70000", kKnown), std::invalid_argument);
  RefineSettings settings;
  settings.classes = "roda";
  EXPECT_NE(message_of(settings).find("'roda'; there are unlabelled, road, car"),
            std::string::npos);
}

TEST(RefineSettings, ARegionHoldsItsBoxAndIsNotTakenForEverything) {
  const Eigen::AlignedBox3d flat(Eigen::Vector3d(-1, 2, 0), Eigen::Vector3d(3, 4, 0));
  const BoxRegion region = region_around(flat, "odom");
  EXPECT_EQ(region.frame_id, "odom");
  EXPECT_LT(region.min.z, 0.0);
  EXPECT_GT(region.max.z, 0.0);
  EXPECT_NEAR(region.min.x, -1.0, 0.01);
  EXPECT_NEAR(region.max.y, 4.0, 0.01);
  const Eigen::AlignedBox3d point(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  EXPECT_NE(region_around(point, ""), BoxRegion());
}

}  // namespace
}  // namespace facet_mapping
