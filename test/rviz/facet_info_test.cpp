// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/facet_info.h"

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

FacetInfo facet_of_a_ramp() {
  FacetInfo facet;
  facet.class_name = "road";
  facet.class_id = 7;
  facet.confidence = 0.5;
  facet.views = 12;
  facet.chunk = {1, -2, 3};
  facet.frame_id = "odom";
  facet.position = {1.0, -0.001, 2.345};
  facet.normal = {-0.6, 0.0, 0.8};
  facet.area_m2 = 0.5;
  return facet;
}

TEST(FacetInfo, EverythingStandsInOneLine) {
  EXPECT_EQ(describe(facet_of_a_ramp()),
            "road (7), confidence 0.50, normal (-0.60, 0.00, 0.80), slope 36.9 deg, area 0.5000 "
            "m^2, views 12, chunk (1, -2, 3), at (1.00, 0.00, 2.35) m in odom");
}

TEST(FacetInfo, WhatIsNotKnownIsSaid) {
  FacetInfo facet = facet_of_a_ramp();
  facet.confidence.reset();
  facet.views.reset();
  EXPECT_EQ(confidence_text(facet), "not known");
  EXPECT_EQ(views_text(facet), "not known");
  facet.views = 255;
  EXPECT_EQ(views_text(facet), "255 or more");
  facet.class_id = kUnlabelled;
  facet.class_name = "unlabelled";
  EXPECT_EQ(class_text(facet), "unlabelled");
}

TEST(FacetInfo, AFacetWithoutAreaHasNeitherNormalNorSlope) {
  FacetInfo facet = facet_of_a_ramp();
  facet.normal.setZero();
  facet.area_m2 = 0.0;
  EXPECT_EQ(slope_deg(facet), std::nullopt);
  EXPECT_EQ(normal_text(facet), "none (no area)");
  EXPECT_EQ(area_text(facet), "0.00 cm^2");
}

TEST(FacetInfo, SlopesRunFromFloorOverWallToCeiling) {
  FacetInfo facet = facet_of_a_ramp();
  facet.normal = Eigen::Vector3d::UnitZ();
  EXPECT_DOUBLE_EQ(slope_deg(facet).value_or(-1.0), 0.0);
  facet.normal = Eigen::Vector3d::UnitX();
  EXPECT_DOUBLE_EQ(slope_deg(facet).value_or(-1.0), 90.0);
  facet.normal = -Eigen::Vector3d::UnitZ();
  EXPECT_DOUBLE_EQ(slope_deg(facet).value_or(-1.0), 180.0);
}

TEST(FacetInfo, SmallFacetsAreMeasuredInSquareCentimetres) {
  FacetInfo facet = facet_of_a_ramp();
  facet.area_m2 = 0.00123;
  EXPECT_EQ(area_text(facet), "12.30 cm^2");
}

}  // namespace
}  // namespace facet_mapping
