// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whoever subscribes late gets the whole mesh, alone; everybody else only what changed.
#include "node_harness.h"
#include <gtest/gtest.h>
#include <visualization_msgs/MarkerArray.h>

#include "facet_mapping/Reset.h"
#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping::test {
namespace {

class LateJoinerTest : public testing::Test {
 protected:
  void SetUp() override {
    publisher_ = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("cloud", 10);
    ASSERT_TRUE(wait_until([this] { return publisher_.getNumSubscribers() > 0; }));
  }

  /// Drives on and waits for the update of the mesh.
  void drive_on(const MeshEar& ear) {
    const std::size_t before = ear.messages();
    const ros::Time now = ros::Time::now();
    publish_sensor_pose(&tf_, x_m_, now);
    publisher_.publish(corridor_cloud(x_m_, now));
    x_m_ += 1.0;
    ASSERT_TRUE(wait_until([&] { return ear.messages() > before; }));
  }

  ros::Publisher publisher_;
  tf2_ros::TransformBroadcaster tf_;
  double x_m_ = 0.0;
};

void expect_equal(const MeshEar& a, const MeshEar& b) {
  EXPECT_EQ(a.receiver().sequence(), b.receiver().sequence());
  EXPECT_EQ(a.receiver().map_id(), b.receiver().map_id());
  const TriangleMesh mesh_a = a.receiver().mesh();
  const TriangleMesh mesh_b = b.receiver().mesh();
  EXPECT_EQ(mesh_a.vertices, mesh_b.vertices);
  EXPECT_EQ(mesh_a.triangles, mesh_b.triangles);
  EXPECT_EQ(mesh_a.labels, mesh_b.labels);
  EXPECT_TRUE(check_manifold(mesh_a).is_closed_manifold());
}

TEST_F(LateJoinerTest, FullMeshForTheNewcomerAndDeltasForAll) {
  const MeshEar first("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return first.messages() == 1; }));
  drive_on(first);
  drive_on(first);
  const MeshEar late("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return late.messages() == 1; }));
  EXPECT_EQ(late.full_messages(), 1U);
  expect_equal(first, late);
  drive_on(first);
  ASSERT_TRUE(wait_until([&] { return late.messages() == 2; }));
  EXPECT_EQ(first.full_messages(), 1U);
  EXPECT_EQ(late.full_messages(), 1U);
  EXPECT_FALSE(first.missed_something());
  EXPECT_FALSE(late.missed_something());
  expect_equal(first, late);

  std::size_t markers = 0;
  const auto subscriber = ros::NodeHandle().subscribe<visualization_msgs::MarkerArray>(
      "mapper/mesh_marker", 1, [&](const visualization_msgs::MarkerArrayConstPtr& array) {
        markers = array->markers.size();
        for (const visualization_msgs::Marker& marker : array->markers) {
          EXPECT_FALSE(marker.points.empty());
        }
      });
  EXPECT_TRUE(wait_until([&] { return markers > 0; }));

  const std::string map_id = first.receiver().map_id();
  Reset reset;
  ASSERT_TRUE(ros::service::call("mapper/reset", reset));
  EXPECT_EQ(reset.response.status.code, Status::OK);
  ASSERT_TRUE(wait_until([&] { return first.receiver().map_id() != map_id; }));
  EXPECT_TRUE(first.receiver().mesh().empty());
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "late_joiner_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
