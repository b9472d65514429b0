// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The images of one moving camera in, clouds out.
#include "moving_camera_checks.h"

namespace facet_mapping::test {
namespace {

class TrackPointsTest : public MovingCameraTest {
 protected:
  static void SetUpTestSuite() { start("track_points"); }
};

TEST_F(TrackPointsTest, PointsOfADriveLieOnTheSurfacesAndHaveClasses) {
  expect_points_of_a_drive();
}

TEST_F(TrackPointsTest, AStandingCameraGivesNoPoints) {
  expect_that_a_standing_camera_is_said();
}

TEST_F(TrackPointsTest, BadImagesAreRefused) {
  expect_that_bad_images_are_refused();
}

TEST_F(TrackPointsTest, AJumpInTimeIsSurvived) {
  expect_that_a_jump_in_time_is_survived();
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "track_points_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
