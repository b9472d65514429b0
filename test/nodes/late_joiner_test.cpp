// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whoever subscribes late gets the whole mesh, alone; everybody else only what changed.
#include <array>
#include <cstdio>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "node_harness.h"
#include <gtest/gtest.h>
#include <visualization_msgs/MarkerArray.h>

#include "facet_mapping/Reset.h"
#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping::test {
namespace {

/// Stands for all bits of a list.
template <typename T>
std::size_t fingerprint(const std::vector<T>& list) {
  const std::string_view bytes(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
  return std::hash<std::string_view>()(bytes);
}

/// One line about what a listener has: equal lines, equal maps.
std::string heard_by(const MeshEar& ear) {
  const TriangleMesh mesh = ear.receiver().mesh();
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold());
  std::ostringstream line;
  line << "full messages " << ear.full_messages() << ", missed " << ear.missed_something()
       << ", map " << ear.receiver().map_id() << ", sequence " << ear.receiver().sequence() << ", "
       << mesh.triangles.size() << " facets " << fingerprint(mesh.triangles) << ", "
       << mesh.vertices.size() << " vertices " << fingerprint(mesh.vertices) << ", labels "
       << fingerprint(mesh.labels);
  return line.str();
}

/// A second process, since the subscribers of one process share their connection.
class OtherProcess {
 public:
  OtherProcess() : pipe_(popen((own_path + " --listen").c_str(), "r")) {}
  ~OtherProcess() {
    if (pipe_ != nullptr) {
      pclose(pipe_);
    }
  }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

  /// What it has after its next message; empty if none came.
  std::string next() {
    std::array<char, 1024> line{};
    if (pipe_ == nullptr || std::fgets(line.data(), line.size(), pipe_) == nullptr) {
      return "";
    }
    const std::string text = line.data();
    return text.substr(0, text.find('\n'));
  }

  static std::string own_path;

 private:
  FILE* pipe_;
};

std::string OtherProcess::own_path;

int listen() {
  const MeshEar ear("mapper/mesh");
  for (std::size_t messages = 1; messages <= 2; ++messages) {
    if (!wait_until([&] { return ear.messages() >= messages; })) {
      return 1;
    }
    std::cout << heard_by(ear) << std::endl;
  }
  return 0;
}

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

TEST_F(LateJoinerTest, FullMeshForTheNewcomerAndDeltasForAll) {
  const MeshEar ear("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return ear.messages() == 1; }));
  drive_on(ear);
  drive_on(ear);
  ASSERT_TRUE(ear.has_facets());
  OtherProcess late;
  EXPECT_EQ(late.next(), heard_by(ear));  // which got its own full mesh, of nothing, at the start
  drive_on(ear);
  EXPECT_EQ(ear.full_messages(), 1U);
  EXPECT_FALSE(ear.missed_something());
  EXPECT_EQ(late.next(), heard_by(ear));
}

TEST_F(LateJoinerTest, MarkersComeToANewcomerAndResetEmptiesTheMesh) {
  const MeshEar ear("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return ear.has_facets(); }));
  std::size_t markers = 0;
  const boost::function<void(const visualization_msgs::MarkerArrayConstPtr&)> receive =
      [&](const visualization_msgs::MarkerArrayConstPtr& array) {
        markers = array->markers.size();
        for (const visualization_msgs::Marker& marker : array->markers) {
          EXPECT_FALSE(marker.action == visualization_msgs::Marker::ADD && marker.points.empty());
        }
      };
  const auto subscriber = ros::NodeHandle().subscribe("mapper/mesh_marker", 1, receive);
  EXPECT_TRUE(wait_until([&] { return markers > 0; }));

  const std::string map_id = ear.receiver().map_id();
  Reset reset;
  ASSERT_TRUE(ros::service::call("mapper/reset", reset));
  EXPECT_EQ(reset.response.status.code, Status::OK);
  ASSERT_TRUE(wait_until([&] { return ear.receiver().map_id() != map_id; }));
  EXPECT_TRUE(ear.receiver().mesh().empty());
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  const bool is_other = argc > 1 && std::string(argv[1]) == "--listen";
  if (!is_other) {
    testing::InitGoogleTest(&argc, argv);
  }
  ros::init(argc, argv, "late_joiner_test", is_other ? ros::init_options::AnonymousName : 0);
  const ros::NodeHandle keeps_the_node_alive;
  if (is_other) {
    return facet_mapping::test::listen();
  }
  facet_mapping::test::OtherProcess::own_path = argv[0];
  return RUN_ALL_TESTS();
}
