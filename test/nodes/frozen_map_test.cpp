// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A drive that leaves frozen chunks behind: whoever asks gets them, too, and deltas hold none.
#include <set>

#include "node_harness.h"
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <visualization_msgs/MarkerArray.h>

#include "facet_mapping/GetMesh.h"
#include "facet_mapping/MeshStats.h"
#include "facet_mapping/Reset.h"
#include "facet_mapping/SaveMesh.h"
#include "facet_mapping/geometry/manifold.h"
#include "facet_mapping/io/ply.h"
#include "facet_mapping/ros/cloud_conversions.h"

namespace facet_mapping::test {
namespace {

constexpr double kStepM = 2.0;
constexpr int kSteps = 24;

/// A straight road between two walls, as a sensor at `x_m` sees it, in frame "sensor".
sensor_msgs::PointCloud2 road_cloud(double x_m, const ros::Time& stamp) {
  std::vector<LabeledPoint> points;
  const auto add = [&](double x, double y, double z, Label label) {
    const double bump = 0.02 * std::sin(5.0 * x + 3.0 * y + 7.0 * z);
    points.push_back(
        {Eigen::Vector3d(x - x_m, y + bump, z - 1.5 + bump).cast<float>(), label, 0.02F});
  };
  for (double x = std::ceil(x_m + 1.0); x < x_m + 10.0; x += 0.5) {
    for (double y = -3.0; y <= 3.0; y += 1.0) {
      add(x, y, 0.0, 0);
    }
    for (double z = 0.5; z <= 3.0; z += 0.5) {
      add(x, 3.5, z, 2);
      add(x, -3.5, z, 2);
    }
  }
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = "sensor";
  return cloud_from_points(points, header);
}

class FrozenMapTest : public ::testing::Test {
 protected:
  void SetUp() override {
    publisher_ = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("cloud", 10);
    stats_sub_ = ros::NodeHandle().subscribe<MeshStats>(
        "mapper/stats", 10, [this](const MeshStatsConstPtr& stats) { stats_ = *stats; });
    ASSERT_TRUE(wait_until([this] { return publisher_.getNumSubscribers() > 0; }));
  }

  /// Drives a step and waits for the update of the mesh.
  void drive_on(const MeshEar& ear) {
    const std::size_t before = ear.messages();
    const ros::Time now = ros::Time::now();
    geometry_msgs::TransformStamped pose;
    pose.header.stamp = now;
    pose.header.frame_id = "map";
    pose.child_frame_id = "sensor";
    pose.transform.translation.x = x_m_;
    pose.transform.translation.z = 1.5;
    pose.transform.rotation.w = 1.0;
    tf_.sendTransform(pose);
    publisher_.publish(road_cloud(x_m_, now));
    x_m_ += kStepM;
    ASSERT_TRUE(wait_until([&] { return ear.messages() > before; }));
  }

  ros::Publisher publisher_;
  ros::Subscriber stats_sub_;
  MeshStats stats_;
  tf2_ros::TransformBroadcaster tf_;
  double x_m_ = 0.0;
};

/// Facets per chunk, which tells whether two meshes have the same chunks.
std::map<ChunkKey, std::size_t> sizes_of(const LabeledMesh& mesh) {
  std::map<ChunkKey, std::size_t> sizes;
  for (const LabeledMeshChunk& chunk : mesh.chunks) {
    sizes[{chunk.key[0], chunk.key[1], chunk.key[2]}] = chunk.triangles.size() / 3;
  }
  return sizes;
}

void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.labels, b.labels);
}

TEST_F(FrozenMapTest, LateSubscribersAndServicesGetTheFrozenPart) {
  auto first = std::make_unique<MeshEar>("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return first->messages() == 1; }));
  for (int k = 0; k < kSteps; ++k) {
    drive_on(*first);
  }
  EXPECT_FALSE(first->missed_something());
  EXPECT_EQ(first->full_messages(), 1U);
  ASSERT_TRUE(wait_until([&] { return stats_.frozen_chunks > 0 && stats_.pending == 0; }));
  const TriangleMesh by_deltas = first->receiver().mesh();
  EXPECT_TRUE(wait_until([&] { return stats_.facets == by_deltas.triangles.size(); }));
  EXPECT_GT(stats_.frozen_facets, stats_.facets / 4);
  EXPECT_LT(stats_.movable_keyframes, stats_.keyframes);
  EXPECT_EQ(stats_.range_scale, 1.0);
  EXPECT_GT(stats_.resident_bytes, 1U << 20U);
  EXPECT_GT(stats_.bytes, stats_.resident_bytes / 2);

  // The late joiner.
  first.reset();
  wait_until([] { return false; }, 0.5);  // the connection has to be closed
  const MeshEar late("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return late.messages() == 1; }));
  EXPECT_EQ(late.full_messages(), 1U);
  expect_same(late.receiver().mesh(), by_deltas);
  EXPECT_TRUE(check_manifold(by_deltas).is_closed_manifold())
      << check_manifold(by_deltas).to_string();

  // The services: whole, a part of the frozen end, and the file.
  GetMesh whole;
  ASSERT_TRUE(ros::service::call("mapper/get_mesh", whole));
  EXPECT_EQ(whole.response.status.code, Status::OK) << whole.response.status.message;
  MeshReceiver receiver;
  receiver.apply(whole.response.mesh);
  expect_same(receiver.mesh(), by_deltas);
  GetMesh part;
  part.request.region.min.x = 2.0;
  part.request.region.max.x = 9.0;
  part.request.region.min.y = part.request.region.min.z = -50.0;
  part.request.region.max.y = part.request.region.max.z = 50.0;
  part.request.classes = {0};
  ASSERT_TRUE(ros::service::call("mapper/get_mesh", part));
  EXPECT_EQ(part.response.status.code, Status::OK) << part.response.status.message;
  std::size_t expected = 0;
  for (std::size_t f = 0; f < by_deltas.triangles.size(); ++f) {
    const Triangle& t = by_deltas.triangles[f];
    const double x = (by_deltas.vertices[t[0]].x() + by_deltas.vertices[t[1]].x() +
                      by_deltas.vertices[t[2]].x()) /
                     3.0;
    expected += x >= 2.0 && x <= 9.0 && by_deltas.labels[f] == 0 ? 1 : 0;
  }
  std::size_t got = 0;
  for (const auto& [key, facets] : sizes_of(part.response.mesh)) {
    got += facets;
  }
  EXPECT_GT(expected, 20U);
  EXPECT_EQ(got, expected);
  SaveMesh save;
  save.request.path = "/tmp/facet_mapping_frozen_map_test.ply";
  ASSERT_TRUE(ros::service::call("mapper/save_mesh", save));
  EXPECT_EQ(save.response.status.code, Status::OK) << save.response.status.message;
  EXPECT_EQ(save.response.facets, by_deltas.triangles.size());
  EXPECT_EQ(read_ply(save.request.path).mesh.triangles.size(), by_deltas.triangles.size());
  std::remove(save.request.path.c_str());

  // Markers and points.
  double shown_min_x = 1e9;
  const auto markers = ros::NodeHandle().subscribe<visualization_msgs::MarkerArray>(
      "mapper/mesh_marker", 1, [&](const visualization_msgs::MarkerArrayConstPtr& array) {
        for (const visualization_msgs::Marker& marker : array->markers) {
          for (const geometry_msgs::Point& point : marker.points) {
            shown_min_x = std::min(shown_min_x, point.x);
          }
        }
      });
  EXPECT_TRUE(wait_until([&] { return shown_min_x < 5.0; }));
  std::uint32_t points = 0;
  const auto cloud = ros::NodeHandle().subscribe<sensor_msgs::PointCloud2>(
      "mapper/mesh_points", 1, [&](const sensor_msgs::PointCloud2ConstPtr& message) {
        points = message->width * message->height;
      });
  EXPECT_TRUE(wait_until([&] { return points == by_deltas.triangles.size(); }));

  Reset reset;
  ASSERT_TRUE(ros::service::call("mapper/reset", reset));
  EXPECT_TRUE(wait_until([&] { return stats_.facets == 0 && stats_.frozen_chunks == 0; }));
}

TEST_F(FrozenMapTest, AClientThatDropsAMessageSeesItAndRecovers) {
  Reset reset;
  ASSERT_TRUE(ros::service::call("mapper/reset", reset));
  const MeshEar ear("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return ear.messages() >= 1; }));
  MeshReceiver lossy;
  std::size_t received = 0;
  std::size_t gaps = 0;
  const auto subscriber = ros::NodeHandle().subscribe<LabeledMesh>(
      "mapper/mesh", 100, [&](const LabeledMeshConstPtr& message) {
        ++received;
        if (received % 5 == 4) {
          return;  // lost on the way
        }
        if (lossy.apply(*message) != MeshReceiver::Result::kGap) {
          return;
        }
        ++gaps;
        GetMesh whole;
        ASSERT_TRUE(ros::service::call("mapper/get_mesh", whole));
        EXPECT_EQ(lossy.apply(whole.response.mesh), MeshReceiver::Result::kApplied);
      });
  for (int k = 0; k < 14; ++k) {
    drive_on(ear);
  }
  ASSERT_TRUE(wait_until([&] { return received >= 13; }));
  EXPECT_GE(gaps, 2U);
  const auto is_level = [&] { return lossy.sequence() == ear.receiver().sequence(); };
  for (int k = 0; k < 5 && !wait_until(is_level, 1.0); ++k) {
    drive_on(ear);  // the last message was one of the lost
  }
  EXPECT_TRUE(is_level());
  expect_same(lossy.mesh(), ear.receiver().mesh());
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "frozen_map_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
