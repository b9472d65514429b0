// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "facet_mapping/ros/transform_queue.h"

namespace facet_mapping {
namespace {

geometry_msgs::TransformStamped transform(const std::string& parent,
                                          const std::string& child,
                                          double stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.header.stamp = ros::Time(stamp);
  transform.child_frame_id = child;
  transform.transform.rotation.w = 1.0;
  return transform;
}

class TransformReportTest : public testing::Test {
 protected:
  std::string explain(const std::string& frame) {
    return explain_missing_transform(buffer_, "map", frame, ros::Time(20.0), 5.0, "tf's own text");
  }
  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  tf2_ros::Buffer buffer_{ros::Duration(100.0)};
};

TEST_F(TransformReportTest, NamesBothFramesTheStampAndTheKnownRange) {
  buffer_.setTransform(transform("map", "base", 10.0), "test");
  buffer_.setTransform(transform("map", "base", 12.5), "test");
  buffer_.setTransform(transform("base", "camera", 0.0), "test", true);
  const std::string text = explain("camera");
  for (const char* part : {"'camera'", "'map'", "20.000", "10.000", "12.500", "use_sim_time"}) {
    EXPECT_TRUE(contains(text, part)) << part << " in: " << text;
  }
}

TEST_F(TransformReportTest, NoTfAtAll) {
  EXPECT_TRUE(contains(explain("camera"), "no frame at all")) << explain("camera");
}

TEST_F(TransformReportTest, UnconnectedFrames) {
  buffer_.setTransform(transform("odom", "base", 10.0), "test");
  EXPECT_TRUE(contains(explain("base"), "not connected")) << explain("base");
  EXPECT_TRUE(contains(explain("elsewhere"), "not connected")) << explain("elsewhere");
}

}  // namespace
}  // namespace facet_mapping
