// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/dataset_bag.h"

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "dataset_messages.h"
#include <rosbag/bag.h>
#include <sensor_msgs/image_encodings.h>

#include "facet_mapping/io/atomic_file.h"

namespace facet_mapping {
namespace {

namespace messages = dataset_messages;

// A subscriber that comes late gets latched topics: rosbag play reads that from the connection.
boost::shared_ptr<ros::M_string> latched_connection() {
  using Message = tf2_msgs::TFMessage;
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype<Message>();
  (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
  (*header)["message_definition"] = ros::message_traits::definition<Message>();
  (*header)["latching"] = "1";
  (*header)["callerid"] = "/kitti_to_bag";
  return header;
}

void check_size(const cv::Mat& image, const PinholeCamera& camera, const std::string& path) {
  if (image.cols != camera.width || image.rows != camera.height) {
    throw std::runtime_error("the image '" + path + "' is " + std::to_string(image.cols) + "x" +
                             std::to_string(image.rows) + " pixels, the calibration is for " +
                             std::to_string(camera.width) + "x" + std::to_string(camera.height));
  }
}

class BagWriter {
 public:
  BagWriter(const Dataset& dataset, const std::string& path, const DatasetBagOptions& options)
      : dataset_(dataset),
        options_(options),
        bag_(std::make_unique<rosbag::Bag>(path, rosbag::bagmode::Write)) {}

  // ~Bag writes the index and ends the program if the disk is full: such a bag is left alone.
  ~BagWriter() {
    try {
      bag_->close();
    } catch (const rosbag::BagException&) {
      static_cast<void>(bag_.release());
    }
  }
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  void write_rig(const DatasetFrame& first) {
    const ros::Time stamp = time_of(first);
    bag_->write("/tf_static", stamp, messages::rig(stamp, dataset_), latched_connection());
    ++report_.messages;
  }

  void write_frame(const DatasetFrame& frame) {
    const ros::Time stamp = time_of(frame);
    write("/tf", stamp, messages::pose(stamp, frame.view));
    write_camera(frame.left_image, frame.view.camera, stamp, messages::kLeftFrame, 0.0);
    if (options_.with_right && dataset_.has_right) {
      write_camera(frame.right_image,
                   frame.view.camera,
                   stamp,
                   messages::kRightFrame,
                   dataset_.baseline_m());
    }
    if (options_.with_labels && !frame.labels.empty()) {
      write(options_.topic_prefix + "/camera_color_left/segmentation",
            stamp,
            messages::segmentation(messages::header(stamp, messages::kLeftFrame),
                                   read_labels(frame.labels)));
      ++report_.label_images;
    }
    if (options_.with_scans && !frame.scan.empty()) {
      write(
          options_.topic_prefix + "/velo/pointcloud",
          stamp,
          messages::cloud(messages::header(stamp, messages::kScannerFrame), read_scan(frame.scan)));
      ++report_.scans;
    }
    ++report_.frames;
  }

  DatasetBagReport close() {
    bag_->close();
    return report_;
  }

 private:
  ros::Time time_of(const DatasetFrame& frame) const {
    const double epoch = dataset_.epoch > 0.0 ? dataset_.epoch : options_.epoch;
    return ros::Time(epoch) + ros::Duration(frame.stamp);
  }

  template <typename Message>
  void write(const std::string& topic, const ros::Time& stamp, const Message& message) {
    bag_->write(topic, stamp, message);
    ++report_.messages;
  }

  void write_camera(const std::string& path,
                    const PinholeCamera& camera,
                    const ros::Time& stamp,
                    const std::string& frame_id,
                    double baseline_m) {
    const std::string topic = options_.topic_prefix + "/" + frame_id;
    const std_msgs::Header header = messages::header(stamp, frame_id);
    const cv::Mat image = read_color(path);
    check_size(image, camera, path);
    write(topic + "/camera_info", stamp, messages::camera_info(header, camera, baseline_m));
    write(topic + "/image_raw",
          stamp,
          messages::image(header, image, sensor_msgs::image_encodings::BGR8));
  }

  const Dataset& dataset_;
  const DatasetBagOptions& options_;
  std::unique_ptr<rosbag::Bag> bag_;
  DatasetBagReport report_;
};

DatasetBagReport write_frames(const Dataset& dataset,
                              const std::string& path,
                              const DatasetBagOptions& options,
                              std::size_t end,
                              const BagProgress& progress) {
  BagWriter writer(dataset, path, options);
  writer.write_rig(dataset.frames[options.first_frame]);
  for (std::size_t k = options.first_frame; k < end; ++k) {
    writer.write_frame(dataset.frames[k]);
    if (progress) {
      progress(k + 1 - options.first_frame, end - options.first_frame);
    }
  }
  return writer.close();
}

}  // namespace

DatasetBagReport write_dataset_bag(const Dataset& dataset,
                                   const std::string& bag_path,
                                   const DatasetBagOptions& options,
                                   const BagProgress& progress) {
  const std::size_t end = end_frame(dataset, options.first_frame, options.last_frame);
  const std::string temporary = temporary_beside(bag_path);
  try {
    const DatasetBagReport report = write_frames(dataset, temporary, options, end, progress);
    publish_file(temporary, bag_path);
    return report;
  } catch (const rosbag::BagException& error) {
    std::filesystem::remove(temporary);
    throw std::runtime_error("cannot write the bag '" + bag_path + "': " + error.what());
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

}  // namespace facet_mapping
