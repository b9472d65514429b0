// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whoever subscribes late gets the whole mesh, alone; everybody else only what changed.
#include <array>
#include <cstdio>

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

/// Is the first mesh message that another process gets a full one? (All subscribers of one process
/// share a connection, so that a second one in this process would be no newcomer.)
std::string newcomers_first_is_full() {
  const std::string command = "rostopic echo -n 1 " + ros::names::resolve("mapper/mesh") + "/full";
  FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  std::array<char, 256> line{};
  while (pipe != nullptr && fgets(line.data(), line.size(), pipe) != nullptr) {
    output += line.data();
  }
  pclose(pipe);
  return output;
}

TEST_F(LateJoinerTest, FullMeshForTheNewcomerAndDeltasForAll) {
  auto first = std::make_unique<MeshEar>("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return first->messages() == 1; }));
  drive_on(*first);
  drive_on(*first);
  EXPECT_NE(newcomers_first_is_full().find("True"), std::string::npos);
  drive_on(*first);
  EXPECT_EQ(first->full_messages(), 1U);
  EXPECT_FALSE(first->missed_something());

  const TriangleMesh by_deltas = first->receiver().mesh();
  const std::string map_id = first->receiver().map_id();
  const std::uint32_t sequence = first->receiver().sequence();
  first.reset();
  wait_until([] { return false; }, 0.5);  // the connection has to be closed
  const MeshEar late("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return late.messages() == 1; }));
  EXPECT_EQ(late.full_messages(), 1U);
  EXPECT_EQ(late.receiver().map_id(), map_id);
  EXPECT_EQ(late.receiver().sequence(), sequence);
  EXPECT_EQ(late.receiver().mesh().vertices, by_deltas.vertices);
  EXPECT_EQ(late.receiver().mesh().triangles, by_deltas.triangles);
  EXPECT_EQ(late.receiver().mesh().labels, by_deltas.labels);
  EXPECT_TRUE(check_manifold(by_deltas).is_closed_manifold());

  std::size_t markers = 0;
  const auto subscriber = ros::NodeHandle().subscribe<visualization_msgs::MarkerArray>(
      "mapper/mesh_marker", 1, [&](const visualization_msgs::MarkerArrayConstPtr& array) {
        markers = array->markers.size();
        for (const visualization_msgs::Marker& marker : array->markers) {
          EXPECT_EQ(marker.points.empty(), marker.action == visualization_msgs::Marker::DELETE);
        }
      });
  EXPECT_TRUE(wait_until([&] { return markers > 0; }));

  Reset reset;
  ASSERT_TRUE(ros::service::call("mapper/reset", reset));
  EXPECT_EQ(reset.response.status.code, Status::OK);
  ASSERT_TRUE(wait_until([&] { return late.receiver().map_id() != map_id; }));
  EXPECT_TRUE(late.receiver().mesh().empty());
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "late_joiner_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
