// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that may be wrong with the input: counted, explained, survived.
#include <cmath>
#include <limits>

#include "node_harness.h"
#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include "facet_mapping/GetMesh.h"
#include "facet_mapping/Refine.h"
#include "facet_mapping/SaveMesh.h"

namespace facet_mapping::test {
namespace {

template <typename Service>
Status call(const std::string& name, const typename Service::Request& request = {}) {
  Service service;
  service.request = request;
  EXPECT_TRUE(ros::service::waitForService(name, 10000));
  EXPECT_TRUE(ros::service::call(name, service)) << name;
  return service.response.status;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// One car for all tests; every frame has a stamp of its own.
class BadInputTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    car_ = std::make_unique<CorridorCar>();
    diagnostics_ = std::make_unique<DiagnosticsEar>();
    tf_ = std::make_unique<tf2_ros::TransformBroadcaster>();
    cloud_pub_ = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("cloud", 10);
    // stereo_points is lazy: without this it would only count the pairs.
    const boost::function<void(const sensor_msgs::PointCloud2ConstPtr&)> ignore = [](const auto&) {
    };
    points_sub_ = ros::NodeHandle().subscribe<sensor_msgs::PointCloud2>("points", 10, ignore);
    connected_ = wait_until([] {
      return car_->is_connected() && cloud_pub_.getNumSubscribers() > 0 &&
             points_sub_.getNumPublishers() > 0;
    });
    wait_until([] { return false; }, 0.5);  // stereo_points must know its subscriber
  }
  void SetUp() override { ASSERT_TRUE(connected_); }
  static void TearDownTestSuite() {
    points_sub_.shutdown();
    cloud_pub_.shutdown();
    tf_.reset();
    diagnostics_.reset();
    car_.reset();
  }

  static ros::Time stamp() {
    stamp_ += ros::Duration(0.1);
    return stamp_;
  }

  /// A good frame after `change`.
  template <typename Change>
  static void publish_frame(const Change& change, bool with_segmentation = true) {
    CorridorCar::Frame frame = CorridorCar::look(0.0, stamp());
    change(frame);
    car_->publish_images(frame, with_segmentation);
  }

  static void expect_stereo_problem(const std::string& reason,
                                    const std::function<void(CorridorCar::Frame&)>& change) {
    EXPECT_TRUE(
        diagnostics_->rises("stereo_points", "problem: " + reason, [&] { publish_frame(change); }));
  }

  /// Of ten pairs one is looked at for what is wrong with it, so ten are changed.
  static void expect_pair_problem(const std::string& reason,
                                  const std::function<void(CorridorCar::Frame&)>& change) {
    EXPECT_TRUE(diagnostics_->rises("stereo_points", "problem: " + reason, [&] {
      for (int k = 0; k < 10; ++k) {
        publish_frame(change);
      }
    })) << reason;
  }

  template <typename Change>
  static void expect_mapper_problem(const std::string& reason, const Change& change) {
    EXPECT_TRUE(diagnostics_->rises("mapper", "problem: " + reason, [&] {
      sensor_msgs::PointCloud2 cloud = corridor_cloud(0.0, stamp());
      publish_sensor_pose(tf_.get(), 0.0, cloud.header.stamp);
      change(cloud);
      cloud_pub_.publish(cloud);
    }));
  }

  static std::unique_ptr<CorridorCar> car_;
  static std::unique_ptr<DiagnosticsEar> diagnostics_;
  static std::unique_ptr<tf2_ros::TransformBroadcaster> tf_;
  static ros::Publisher cloud_pub_;
  static ros::Subscriber points_sub_;
  static ros::Time stamp_;
  static bool connected_;
};

std::unique_ptr<CorridorCar> BadInputTest::car_;
std::unique_ptr<DiagnosticsEar> BadInputTest::diagnostics_;
std::unique_ptr<tf2_ros::TransformBroadcaster> BadInputTest::tf_;
ros::Publisher BadInputTest::cloud_pub_;
ros::Subscriber BadInputTest::points_sub_;
ros::Time BadInputTest::stamp_(1000.0);
bool BadInputTest::connected_ = false;

TEST_F(BadInputTest, ServicesBeforeAnyMeshSayWhatIsMissing) {
  const Status refine = call<Refine>("refiner/refine");
  EXPECT_EQ(refine.code, Status::NOT_READY);
  EXPECT_TRUE(contains(refine.message, "no mesh")) << refine.message;
  EXPECT_TRUE(contains(refine.message, "0 keyframes")) << refine.message;
  EXPECT_TRUE(contains(refine.message, "/mapper/mesh")) << refine.message;
  SaveMesh::Request save;
  save.path = "/tmp/never_written.ply";
  EXPECT_EQ(call<SaveMesh>("mapper/save_mesh", save).code, Status::NOT_READY);
  EXPECT_EQ(call<GetMesh>("mapper/get_mesh").code, Status::NOT_READY);
}

TEST_F(BadInputTest, WrongOrMissingImageEncoding) {
  expect_stereo_problem("unusable pair", [](auto& frame) { frame.left.encoding = "nonsense"; });
  expect_stereo_problem("unusable pair", [](auto& frame) { frame.right.encoding = ""; });
  expect_stereo_problem("unusable pair", [](auto& frame) { frame.left.data.resize(10); });
}

TEST_F(BadInputTest, ImagesOfDifferentSizes) {
  expect_stereo_problem("unusable pair", [](auto& frame) {
    frame.right.height /= 2;
    frame.right.data.resize(frame.right.data.size() / 2);
  });
}

TEST_F(BadInputTest, CameraInfoWithoutIntrinsicsOrSwapped) {
  expect_stereo_problem("unusable pair", [](auto& frame) {
    frame.left_info.K.fill(0.0);
    frame.left_info.P.fill(0.0);
  });
  expect_stereo_problem("unusable pair", [](auto& frame) { frame.right_info.P[3] *= -1.0; });
}

TEST_F(BadInputTest, PairsThatAreNoRectifiedPair) {
  expect_pair_problem("left and right swapped",
                      [](auto& frame) { std::swap(frame.left.data, frame.right.data); });
  expect_pair_problem("unrectified pair", [](auto& frame) {
    std::rotate(frame.right.data.begin(),
                frame.right.data.begin() + 4 * frame.right.step,
                frame.right.data.end());
  });
  expect_pair_problem("exposures differ", [](auto& frame) {
    for (std::uint8_t& value : frame.right.data) {
      value /= 2;
    }
  });
  expect_pair_problem("blank image", [](auto& frame) {
    std::fill(frame.right.data.begin(), frame.right.data.end(), std::uint8_t{90});
  });
}

TEST_F(BadInputTest, UnusableSegmentation) {
  expect_stereo_problem("unusable segmentation",
                        [](auto& frame) { frame.segmentation.encoding = "32FC1"; });
  expect_stereo_problem("unusable segmentation",
                        [](auto& frame) { frame.segmentation.encoding = ""; });
  expect_stereo_problem("segmentation resampled", [](auto& frame) {
    frame.segmentation.width /= 2;
    frame.segmentation.step /= 2;
    frame.segmentation.height /= 2;
    frame.segmentation.data.resize(frame.segmentation.data.size() / 4);
  });
  expect_stereo_problem("segmentation of another size", [](auto& frame) {
    frame.segmentation.height /= 2;
    frame.segmentation.data.resize(frame.segmentation.data.size() / 2);
  });
}

TEST_F(BadInputTest, UnknownClassIds) {
  expect_stereo_problem("unknown classes", [](auto& frame) {
    std::fill_n(frame.segmentation.data.begin(), 1000, std::uint8_t{77});
  });
}

TEST_F(BadInputTest, SegmentationNeverComesAndThePairGoesOn) {
  const std::uint64_t clouds = diagnostics_->value("stereo_points", "clouds published");
  EXPECT_TRUE(diagnostics_->rises(
      "stereo_points", "problem: no segmentation", [] { publish_frame([](auto&) {}, false); }));
  EXPECT_TRUE(wait_until(
      [&] { return diagnostics_->value("stereo_points", "clouds published") > clouds; }));
}

TEST_F(BadInputTest, ImagesWithoutStamp) {
  expect_stereo_problem("no stamp", [](auto& frame) { frame.left.header.stamp = ros::Time(); });
}

TEST_F(BadInputTest, PoseThatNeverComes) {
  expect_mapper_problem("no transform",
                        [](auto& cloud) { cloud.header.frame_id = "frame_without_tf"; });
}

TEST_F(BadInputTest, PoseThatComesLateIsWaitedFor) {
  const std::uint64_t dropped = diagnostics_->value("mapper", "problem: no transform");
  EXPECT_TRUE(diagnostics_->rises("mapper", "keyframes", [] {
    const sensor_msgs::PointCloud2 cloud = corridor_cloud(0.0, stamp());
    cloud_pub_.publish(cloud);
    wait_until([] { return false; }, 0.5);
    publish_sensor_pose(tf_.get(), 0.0, cloud.header.stamp);
  }));
  EXPECT_EQ(diagnostics_->value("mapper", "problem: no transform"), dropped);
}

TEST_F(BadInputTest, PoseThatIsNotANumber) {
  EXPECT_TRUE(diagnostics_->rises("mapper", "problem: no transform", [] {
    const sensor_msgs::PointCloud2 cloud = corridor_cloud(0.0, stamp());
    publish_sensor_pose(tf_.get(), std::numeric_limits<double>::quiet_NaN(), cloud.header.stamp);
    cloud_pub_.publish(cloud);
  }));
}

TEST_F(BadInputTest, UnusableClouds) {
  expect_mapper_problem("empty cloud", [](auto& cloud) {
    cloud.width = 0;
    cloud.row_step = 0;
    cloud.data.clear();
  });
  expect_mapper_problem("unusable cloud", [](auto& cloud) { cloud.fields[0].name = "range"; });
  expect_mapper_problem("unusable cloud", [](auto& cloud) { cloud.data.resize(7); });
  expect_mapper_problem("no frame_id", [](auto& cloud) { cloud.header.frame_id = ""; });
  expect_mapper_problem("unknown classes", [](auto& cloud) {
    cloud.header.stamp = stamp();
    publish_sensor_pose(tf_.get(), 3.0, cloud.header.stamp);
    sensor_msgs::PointCloud2Iterator<std::uint16_t> label(cloud, "label");
    *label = 999;
  });
  expect_mapper_problem("no usable point", [](auto& cloud) {
    cloud.header.stamp = stamp();
    publish_sensor_pose(tf_.get(), 5.0, cloud.header.stamp);
    for (sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"); x != x.end(); ++x) {
      *x = std::numeric_limits<float>::quiet_NaN();
    }
  });
}

TEST_F(BadInputTest, SavePathsThatCannotBeWritten) {
  ASSERT_TRUE(wait_until(
      [] { return diagnostics_->value("mapper", "facets") > 0 && diagnostics_->hears("mapper"); }));
  SaveMesh::Request request;
  request.path = "/proc/no/mesh.ply";
  const Status status = call<SaveMesh>("mapper/save_mesh", request);
  EXPECT_EQ(status.code, Status::IO_ERROR);
  EXPECT_TRUE(contains(status.message, "/proc/no")) << status.message;
  for (const char* path : {"", "/tmp/", "/tmp/mesh.obj"}) {
    request.path = path;
    EXPECT_EQ(call<SaveMesh>("mapper/save_mesh", request).code, Status::INVALID_ARGUMENT) << path;
  }
}

TEST_F(BadInputTest, RefineWithOneKeyframe) {
  EXPECT_TRUE(diagnostics_->rises("refiner", "keyframes", [] { car_->drive_to(0.0, stamp()); }));
  const Status status = call<Refine>("refiner/refine");
  EXPECT_EQ(status.code, Status::NOT_READY);
  EXPECT_TRUE(contains(status.message, "1 keyframes, but 2 are needed")) << status.message;
  EXPECT_FALSE(contains(status.message, "no mesh")) << status.message;
}

TEST_F(BadInputTest, ClockJumpingBack) {
  const MeshEar mesh("mapper/mesh");
  ASSERT_TRUE(wait_until([&] { return mesh.has_facets(); }));
  const std::string map_id = mesh.receiver().map_id();
  stamp_ = ros::Time(500.0);
  expect_mapper_problem("time jumped back", [](auto&) {});
  // The jump empties the tf buffer, so that the pose of that first cloud may be lost.
  EXPECT_TRUE(diagnostics_->rises("mapper", "keyframes", [] {
    const sensor_msgs::PointCloud2 cloud = corridor_cloud(0.0, stamp());
    publish_sensor_pose(tf_.get(), 2.0, cloud.header.stamp);
    cloud_pub_.publish(cloud);
  }));
  EXPECT_TRUE(wait_until([&] { return mesh.receiver().map_id() != map_id && mesh.has_facets(); }));
  expect_stereo_problem("time jumped back", [](auto&) {});
  EXPECT_GT(diagnostics_->value("refiner", "problem: time jumped back"), 0U);
  EXPECT_TRUE(diagnostics_->rises("refiner", "keyframes", [] { car_->drive_to(0.0, stamp()); }));
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "bad_input_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
