// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/temp_folder.h"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "facet_mapping/geometry/label.h"
#include "facet_mapping/io/dataset.h"

namespace facet_mapping {
namespace {

using testing::error_of;
using testing::TempFolder;

TEST(Images, DepthInMetres) {
  const TempFolder folder;
  cv::Mat image(2, 2, CV_16U, cv::Scalar(0));
  image.at<unsigned short>(0, 1) = 640;
  image.at<unsigned short>(1, 0) = 65535;
  cv::imwrite(folder / "depth.png", image);
  const cv::Mat depth = read_depth(folder / "depth.png", 256.0);
  EXPECT_EQ(depth.type(), CV_32F);
  EXPECT_EQ(depth.at<float>(0, 0), 0.0F);
  EXPECT_EQ(depth.at<float>(0, 1), 2.5F);
  EXPECT_NEAR(depth.at<float>(1, 0), 255.996F, 1e-3F);
  cv::imwrite(folder / "grey.png", cv::Mat(2, 2, CV_8U, cv::Scalar(7)));
  EXPECT_NE(error_of([&] { read_depth(folder / "grey.png", 256.0); }).find("16 bits"),
            std::string::npos);
}

TEST(Images, LabelsKeepIdsAndMarkVoid) {
  const TempFolder folder;
  cv::Mat image(1, 3, CV_8U, cv::Scalar(0));
  image.at<unsigned char>(0, 1) = 18;
  image.at<unsigned char>(0, 2) = 255;
  cv::imwrite(folder / "labels.png", image);
  const cv::Mat labels = read_labels(folder / "labels.png");
  EXPECT_EQ(labels.type(), CV_16UC1);
  EXPECT_EQ(labels.at<Label>(0, 0), 0);
  EXPECT_EQ(labels.at<Label>(0, 1), 18);
  EXPECT_EQ(labels.at<Label>(0, 2), kUnlabelled);
  cv::imwrite(folder / "wide.png", cv::Mat(1, 1, CV_16U, cv::Scalar(255)));
  EXPECT_EQ(read_labels(folder / "wide.png").at<Label>(0, 0), 255);
  cv::imwrite(folder / "color.png", cv::Mat(1, 1, CV_8UC3));
  EXPECT_NE(error_of([&] { read_labels(folder / "color.png"); }).find("class ids in one channel"),
            std::string::npos);
}

TEST(Images, TruncatedFilesAreNamed) {
  const TempFolder folder;
  cv::Mat noise(64, 64, CV_8UC3);
  cv::randu(noise, 0, 255);
  for (const char* name : {"image.png", "image.jpg"}) {
    const std::string path = folder / name;
    cv::imwrite(path, noise);
    EXPECT_EQ(read_color(path).type(), CV_8UC3);
    EXPECT_EQ(read_gray(path).type(), CV_8UC1);
    const std::string whole = testing::read_text(path);
    for (std::size_t size = 0; size < whole.size(); size += 997) {
      testing::write_text(path, whole.substr(0, size));
      const std::string error = error_of([&] { read_color(path); });
      EXPECT_NE(error.find(path + "' is truncated"), std::string::npos) << size << error;
    }
  }
  testing::write_text(folder / "text.png", "no image but IEND1234");
  EXPECT_NE(error_of([&] { read_gray(folder / "text.png"); }).find("damaged"), std::string::npos);
  EXPECT_NE(error_of([&] { read_gray(folder / "no.png"); }).find("does not exist"),
            std::string::npos);
}

TEST(Images, Scans) {
  const TempFolder folder;
  const float points[] = {1.0F, 2.0F, 3.0F, 0.5F, 4.0F, 5.0F, 6.0F, 0.25F};
  const std::string bytes(reinterpret_cast<const char*>(points), sizeof(points));
  testing::write_text(folder / "scan.bin", bytes);
  const auto scan = read_scan(folder / "scan.bin");
  ASSERT_EQ(scan.size(), 2U);
  EXPECT_EQ(scan[1], Eigen::Vector4f(4, 5, 6, 0.25F));
  testing::write_text(folder / "scan.bin", bytes.substr(0, 30));
  EXPECT_NE(error_of([&] { read_scan(folder / "scan.bin"); }).find("30 bytes"), std::string::npos);
  testing::write_text(folder / "scan.bin", "");
  EXPECT_NE(error_of([&] { read_scan(folder / "scan.bin"); }).find("0 bytes"), std::string::npos);
  EXPECT_NE(error_of([&] { read_scan(folder / "no.bin"); }).find("no.bin"), std::string::npos);
}

}  // namespace
}  // namespace facet_mapping
