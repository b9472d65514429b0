// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every rig that the launch arguments can describe yields a mesh, with the right classes or
// without.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "../support/onnx_file.h"
#include "corridor.h"
#include "launched_chain.h"
#include "node_harness.h"
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include "facet_mapping/geometry/facet_centroid.h"
#include "facet_mapping/ros/cloud_conversions.h"
#include "facet_mapping/segmentation/forest_training.h"

namespace facet_mapping::test {
namespace {

constexpr char kLabelFile[] =
    "classes:\n"
    "  - {id: 0, name: road, color: [128, 64, 128]}\n"
    "  - {id: 2, name: building, color: [70, 70, 70]}\n";
// Small images, quick answers.
constexpr char kOverlay[] =
    "stereo_points: {diagnostic_period: 0.2, stereo: {num_disparities: 64}}\n"
    "track_points: {diagnostic_period: 0.2, queue_size: 100, flush_after_s: 1.0}\n"
    "sweep_points: {diagnostic_period: 0.2, queue_size: 100, flush_after_s: 1.0}\n"
    "lidar_points: {diagnostic_period: 0.2, outlier_neighbors: 0}\n"
    "segmenter: {queue_size: 100, network: {input_width: 320, input_height: 200}}\n"
    "mapper: {diagnostic_period: 0.2, update_period_s: 0.2, carving: {steiner_reach_m: 25.0}}\n";

/// The corridor with a reddish road and bluish walls, so that a network can tell them by colour.
cv::Mat tinted(const cv::Mat& gray, const cv::Mat& labels) {
  cv::Mat strong;
  cv::Mat weak;
  gray.copyTo(strong);
  gray.convertTo(weak, CV_8U, 0.5);
  cv::Mat blue = strong.clone();
  cv::Mat red = weak.clone();
  weak.copyTo(blue, labels == static_cast<int>(kRoad));
  strong.copyTo(red, labels == static_cast<int>(kRoad));
  cv::Mat image;
  cv::merge(std::vector<cv::Mat>{blue, gray, red}, image);
  return image;
}

cv::Mat wide(const cv::Mat& ids) {
  cv::Mat labels;
  ids.convertTo(labels, CV_16U);
  return labels;
}

/// The cloud as a scanner gives it, without classes.
sensor_msgs::PointCloud2 plain_cloud(double x_m, const ros::Time& stamp) {
  const sensor_msgs::PointCloud2 labelled = corridor_cloud(x_m, stamp);
  const std::vector<LabeledPoint> points = points_from_cloud(labelled);
  sensor_msgs::PointCloud2 cloud;
  cloud.header = labelled.header;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
  for (const LabeledPoint& point : points) {
    std::copy_n(point.position.data(), 3, &x[0]);
    ++x;
  }
  return cloud;
}

struct Score {
  std::size_t labelled = 0;
  std::size_t right = 0;  ///< of those whose place says which class they are
  std::size_t wrong = 0;
};

Score score(const TriangleMesh& mesh) {
  Score result;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (mesh.labels[f] == kUnlabelled) {
      continue;
    }
    ++result.labelled;
    const double height = facet_centroid(mesh.vertices, mesh.triangles[f]).z();
    if (height < 0.3 || height > 0.6) {
      const Label expected = height < 0.3 ? kRoad : kBuilding;
      ++(mesh.labels[f] == expected ? result.right : result.wrong);
    }
  }
  return result;
}

using Rig = std::tuple<std::string, bool, std::string>;  // camera, lidar, segmentation

class LaunchCombinationsTest : public ::testing::TestWithParam<Rig> {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::path(::testing::TempDir()) / "facet_mapping_launch_combinations";
    std::filesystem::create_directories(folder_);
    facet_mapping::testing::write_bytes(path("classes.yaml"), kLabelFile);
    facet_mapping::testing::write_bytes(path("overlay.yaml"), kOverlay);
    // Channels are red, green, blue: the road is red, the walls are blue.
    facet_mapping::testing::write_bytes(
        path("network"),
        facet_mapping::testing::onnx_classifier({{1, 0, -1}, {-1, 0, 1}}, {0, 0}, 320, 200));
    std::vector<TrainingImage> images;
    for (const double x_m : {0.0, 3.0}) {
      const cv::Mat ids = draw_labels(map_from_left(x_m));
      images.push_back({tinted(draw_gray(map_from_left(x_m)), ids), wide(ids), {}});
    }
    ForestTrainingConfig config;
    config.trees = 10;
    save_forest(train_forest(images, LabelSet::load(path("classes.yaml")), config), path("forest"));
    ros::NodeHandle nh;
    image_ = nh.advertise<sensor_msgs::Image>("left/image_rect", 100);
    right_ = nh.advertise<sensor_msgs::Image>("right/image_rect", 100);
    info_ = nh.advertise<sensor_msgs::CameraInfo>("left/camera_info", 100);
    right_info_ = nh.advertise<sensor_msgs::CameraInfo>("right/camera_info", 100);
    segmentation_ = nh.advertise<sensor_msgs::Image>("segmentation", 100);
    cloud_ = nh.advertise<sensor_msgs::PointCloud2>("point_cloud", 100);
    tf_ = std::make_unique<tf2_ros::TransformBroadcaster>();
    car_ = std::make_unique<CorridorCar>();
  }
  static void TearDownTestSuite() {
    std::filesystem::remove_all(folder_);
    tf_.reset();
    car_.reset();
  }

  static std::string path(const std::string& name) { return (folder_ / name).string(); }

  static std::vector<std::string> arguments(const Rig& rig) {
    const auto& [camera, lidar, segmentation] = rig;
    std::vector<std::string> words{"camera:=" + camera,
                                   std::string("lidar:=") + (lidar ? "true" : "false"),
                                   "segmentation:=" + segmentation,
                                   "label_file:=" + path("classes.yaml"),
                                   "overlay:=" + path("overlay.yaml"),
                                   "mono_points:=both",
                                   "refine:=false"};
    if (segmentation == "network" || segmentation == "forest") {
      words.push_back("model:=" + path(segmentation));
    }
    return words;
  }

  static std::vector<std::string> sources(const Rig& rig) {
    const auto& [camera, lidar, segmentation] = rig;
    std::vector<std::string> nodes;
    if (camera == "stereo") {
      nodes = {"stereo_points"};
    } else if (camera == "mono") {
      nodes = {"track_points", "sweep_points"};
    }
    if (lidar) {
      nodes.emplace_back("lidar_points");
    }
    return nodes;
  }

  static void drive_to(double x_m, const Rig& rig) {
    const ros::Time stamp = ros::Time::now();
    car_->publish_pose(x_m, stamp);
    publish_sensor_pose(tf_.get(), x_m, stamp);
    CorridorCar::Frame frame = CorridorCar::look(x_m, stamp);
    const cv::Mat ids = draw_labels(map_from_left(x_m));
    const cv::Mat gray = draw_gray(map_from_left(x_m));
    image_.publish(cv_bridge::CvImage(frame.left.header, "bgr8", tinted(gray, ids)).toImageMsg());
    info_.publish(frame.left_info);
    right_.publish(frame.right);
    right_info_.publish(frame.right_info);
    if (std::get<2>(rig) == "topic") {
      segmentation_.publish(frame.segmentation);
    }
    if (std::get<1>(rig)) {
      cloud_.publish(plain_cloud(x_m, stamp));
    }
  }

  inline static std::filesystem::path folder_;
  inline static ros::Publisher image_;
  inline static ros::Publisher right_;
  inline static ros::Publisher info_;
  inline static ros::Publisher right_info_;
  inline static ros::Publisher segmentation_;
  inline static ros::Publisher cloud_;
  inline static std::unique_ptr<tf2_ros::TransformBroadcaster> tf_;
  inline static std::unique_ptr<CorridorCar> car_;  // its topics are ours, its poses are used
};

TEST_P(LaunchCombinationsTest, YieldsAMesh) {
  const Rig rig = GetParam();
  LaunchedChain chain(arguments(rig));
  const MeshEar mesh("mapper/mesh");
  const DiagnosticsEar diagnostics;
  double x_m = 0.0;
  // Nodes connect in their own time: the car goes on until every source has given points and the
  // map has facets, and stands at the end of the corridor.
  const auto is_mapped = [&] {
    drive_to(x_m, rig);
    x_m = std::min(x_m + 0.4, 8.0);
    wait_until([] { return false; }, 0.15);
    for (const std::string& node : sources(rig)) {
      if (diagnostics.value(node, "clouds published") < 3) {
        return false;
      }
    }
    return mesh.has_facets() || !chain.is_running();
  };
  ASSERT_TRUE(wait_until(is_mapped, 60.0));
  ASSERT_TRUE(chain.is_running());
  const auto is_full = [&] { return mesh.receiver().mesh().triangles.size() > 500; };
  ASSERT_TRUE(wait_until([&] { return is_full() || (drive_to(x_m, rig), false); }, 20.0));
  wait_until([] { return false; }, 1.0);  // what still waits
  const Score result = score(mesh.receiver().mesh());
  if (std::get<2>(rig) == "none") {
    EXPECT_EQ(result.labelled, 0U);
  } else {
    EXPECT_GT(result.labelled, mesh.receiver().mesh().triangles.size() / 4);
    EXPECT_GT(result.right, 9 * result.wrong);
  }
}

std::string name_of(const ::testing::TestParamInfo<Rig>& info) {
  const auto& [camera, lidar, segmentation] = info.param;
  return camera + (lidar ? "_lidar_" : "_") + segmentation;
}

INSTANTIATE_TEST_SUITE_P(
    Cameras,
    LaunchCombinationsTest,
    ::testing::Combine(::testing::Values("mono", "stereo"),
                       ::testing::Bool(),
                       ::testing::Values("topic", "network", "forest", "none")),
    name_of);
INSTANTIATE_TEST_SUITE_P(
    NoCamera,
    LaunchCombinationsTest,
    ::testing::Combine(::testing::Values("none"),
                       ::testing::Values(true),
                       ::testing::Values("topic", "network", "forest", "none")),
    name_of);

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "launch_combinations_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
