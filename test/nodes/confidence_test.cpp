// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Confidence images beside the segmentation, and the table of classes in the diagnostics.
#include <memory>

#include "corridor.h"
#include "node_harness.h"
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>

#include "facet_mapping/ros/cloud_conversions.h"

namespace facet_mapping::test {
namespace {

class ConfidenceTest : public testing::Test {
 protected:
  void SetUp() override {
    ros::NodeHandle nh;
    confidence_ = nh.advertise<sensor_msgs::Image>("segmentation_confidence", 10);
    const boost::function<void(const sensor_msgs::PointCloud2ConstPtr&)> keep =
        [this](const sensor_msgs::PointCloud2ConstPtr& cloud) { cloud_ = cloud; };
    ear_ = nh.subscribe<sensor_msgs::PointCloud2>("points", 10, keep);
    ASSERT_TRUE(wait_until(
        [this] { return confidence_.getNumSubscribers() > 0 && ear_.getNumPublishers() > 0; }));
    // The other topics connect in their own time.
    ASSERT_TRUE(wait_until([this] { return publish(255); }, 30.0));
  }

  /// Publishes a frame whose left half is as sure as given (below 0: no confidence image) and whose
  /// right half is certain; true if a cloud of it came.
  bool publish(int left_half) {
    stamp_ += ros::Duration(0.1);
    const CorridorCar::Frame frame = CorridorCar::look(0.0, stamp_);
    if (left_half >= 0) {
      cv::Mat confidence(200, 320, CV_8UC1, cv::Scalar(255));
      confidence.colRange(0, 160).setTo(left_half);
      confidence_.publish(cv_bridge::CvImage(frame.left.header, "mono8", confidence).toImageMsg());
    }
    car_.publish_images(frame);
    return wait_until([this] { return cloud_ != nullptr && cloud_->header.stamp == stamp_; }, 3.0);
  }

  /// Points with a class to the left and to the right of the camera's axis.
  std::pair<int, int> labelled() const {
    std::pair<int, int> count{0, 0};
    for (const LabeledPoint& point : points_from_cloud(*cloud_)) {
      if (point.label != kUnlabelled) {
        ++(point.position.x() < 0.0F ? count.first : count.second);
      }
    }
    return count;
  }

  DiagnosticsEar diagnostics_;
  CorridorCar car_;
  ros::Time stamp_{1000.0};
  ros::Publisher confidence_;
  ros::Subscriber ear_;
  sensor_msgs::PointCloud2ConstPtr cloud_;
};

TEST_F(ConfidenceTest, UnsurePixelsGiveUnlabelledPoints) {
  ASSERT_TRUE(publish(200));
  EXPECT_GT(labelled().first, 100);
  EXPECT_GT(labelled().second, 100);
  ASSERT_TRUE(publish(100));
  EXPECT_EQ(labelled().first, 0);
  EXPECT_GT(labelled().second, 100);
}

TEST_F(ConfidenceTest, WithoutConfidenceAllPixelsAreSureAndItIsSaid) {
  EXPECT_TRUE(diagnostics_.rises(
      "stereo_points", "problem: no confidence", [this] { EXPECT_TRUE(publish(-1)); }));
  EXPECT_GT(labelled().first, 100);
}

TEST_F(ConfidenceTest, TheTableOfClassesSaysWhatCame) {
  ASSERT_TRUE(diagnostics_.hears("stereo_points"));
  const std::string seen = diagnostics_.text("stereo_points", "class ids seen");
  EXPECT_NE(seen.find("0 road"), std::string::npos) << seen;
  EXPECT_NE(seen.find("2 building"), std::string::npos) << seen;
  const std::string missing = diagnostics_.text("stereo_points", "class ids never seen");
  EXPECT_NE(missing.find("13 car"), std::string::npos) << missing;
  EXPECT_EQ(missing.find("0 road,"), std::string::npos) << missing;
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "confidence_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
