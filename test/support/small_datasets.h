// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Tiny dataset folders of every layout, three frames of 8x6 pixels.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "io/temp_folder.h"
#include <opencv2/imgcodecs.hpp>

namespace facet_mapping::testing {

constexpr int kFrames = 3;
constexpr int kWidth = 8;
constexpr int kHeight = 6;

inline void write_image(const std::string& path, const cv::Mat& image) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  cv::imwrite(path, image);
}

inline cv::Mat picture(int frame) {
  cv::Mat image(kHeight, kWidth, CV_8UC3);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      image.at<cv::Vec3b>(row, column) = cv::Vec3b(static_cast<unsigned char>(10 * column),
                                                   static_cast<unsigned char>(10 * row),
                                                   static_cast<unsigned char>(frame));
    }
  }
  return image;
}

inline void write_scan(const std::string& path) {
  const float points[] = {5.0F, 0.0F, 0.0F, 0.25F, 6.0F, 1.0F, -1.0F, 0.5F};
  write_text(path, std::string(reinterpret_cast<const char*>(points), sizeof(points)));
}

inline std::string pose_rows() {
  std::string rows;
  for (int k = 0; k < kFrames; ++k) {
    rows += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(k) + "\n";
  }
  return rows;
}

/// "000002" for (2, 6).
inline std::string padded(int number, int digits) {
  const std::string text = std::to_string(number);
  return std::string(static_cast<std::size_t>(digits) - text.size(), '0') + text;
}

/// left/ right/ labels/ gt_label/ gt_depth/ velodyne/ calib.txt poses.txt times.txt; K = 10 0 4 / 0
/// 10 3, baseline 0.5 m, one metre forward per frame.
inline void make_plain(const std::string& folder) {
  for (int k = 0; k < kFrames; ++k) {
    const std::string name = "/" + padded(k, 6);
    write_image(folder + "/left" + name + ".png", picture(k));
    write_image(folder + "/right" + name + ".png", picture(k));
    write_image(folder + "/labels" + name + ".png", cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(k)));
    write_image(folder + "/gt_label" + name + ".png",
                cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(255)));
    write_image(folder + "/gt_depth" + name + ".png",
                cv::Mat(kHeight, kWidth, CV_16U, cv::Scalar(512)));
    write_scan(folder + "/velodyne" + name + ".bin");
  }
  write_text(folder + "/calib.txt",
             "K: 10 0 4 0 10 3 0 0 1\nT_right_left: 1 0 0 -0.5 0 1 0 0.01 0 0 1 0.02\n"
             "T_left_velo: 0 -1 0 0 0 0 -1 -0.1 1 0 0 -0.3\nbaseline_m: 0.5\n");
  write_text(folder + "/poses.txt", pose_rows());
  write_text(folder + "/times.txt", "0\n0.1\n0.2\n");
}

/// The same as image_2/, image_3/ ..., camera 2 standing 0.06 m left of the pose camera (x =
/// -0.06).
inline void make_odometry(const std::string& folder) {
  for (int k = 0; k < kFrames; ++k) {
    const std::string name = "/" + padded(k, 6);
    write_image(folder + "/image_2" + name + ".png", picture(k));
    write_image(folder + "/image_3" + name + ".png", picture(k));
    write_scan(folder + "/velodyne" + name + ".bin");
  }
  write_text(folder + "/calib.txt",
             "P0: 10 0 4 0 0 10 3 0 0 0 1 0\nP1: 10 0 4 -5 0 10 3 0 0 0 1 0\n"
             "P2: 10 0 4 0.6 0 10 3 0 0 0 1 0\nP3: 10 0 4 -4.4 0 10 3 0 0 0 1 0\n"
             "Tr: 0 -1 0 0 0 0 -1 -0.1 1 0 0 -0.3\n");
  write_text(folder + "/poses.txt", pose_rows());
  write_text(folder + "/times.txt", "0\n0.1\n0.2\n");
}

/// A day folder with one drive; returns the drive's folder. The car drives 1 m east per frame, the
/// camera looks along the car.
inline std::string make_raw(const std::string& day) {
  const std::string drive = day + "/2011_09_26_drive_0001_sync";
  std::string times;
  for (int k = 0; k < kFrames; ++k) {
    const std::string name = padded(k, 10);
    write_image(drive + "/image_02/data/" + name + ".png", picture(k));
    write_image(drive + "/image_03/data/" + name + ".png", picture(k));
    write_image(drive + "/labels/" + name + ".png", cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(k)));
    // One metre east at the equator, where the projection's scale is one.
    const double longitude = 8.0 + k / 6378137.0 * 180.0 / M_PI;
    char packet[200];
    std::snprintf(packet, sizeof(packet), "0.0 %.12f 110.0 0 0 0", longitude);
    std::string text = packet;
    for (int rest = 6; rest < 30; ++rest) {
      text += " 0";
    }
    write_text(drive + "/oxts/data/" + name + ".txt", text + "\n");
    times += "2011-09-26 13:02:2" + std::to_string(5 + k) + ".500000000\n";
  }
  write_text(drive + "/image_02/timestamps.txt", times);
  write_scan(drive + "/velodyne_points/data/" + padded(1, 10) + ".bin");
  write_text(day + "/calib_cam_to_cam.txt",
             "calib_time: 09-Jan-2012 13:57:47\nR_rect_00: 1 0 0 0 1 0 0 0 1\n"
             "P_rect_02: 10 0 4 0.6 0 10 3 0 0 0 1 0\nP_rect_03: 10 0 4 -4.4 0 10 3 0 0 0 1 0\n");
  write_text(day + "/calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 -0.1 -0.3\n");
  write_text(day + "/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n");
  return drive;
}

/// cameras.json with two views at (0, 0, 0) and (1, 2, 3), images as PNG.
inline void make_strecha(const std::string& folder) {
  write_image(folder + "/images/0000.png", picture(0));
  write_image(folder + "/images/0001.png", picture(1));
  write_image(folder + "/depth_gt/0001.png", cv::Mat(kHeight, kWidth, CV_16U, cv::Scalar(500)));
  const std::string camera =
      R"("width": 8, "height": 6, "fx": 10, "fy": 11, "cx": 3.5, "cy": 2.5,)";
  write_text(folder + "/cameras.json",
             R"({"views": [{"image": "images/0000.png",)" + camera +
                 R"("rotation_cam_from_world": [[1,0,0],[0,1,0],[0,0,1]],
             "translation_cam_from_world": [0,0,0]}, {"image": "images/0001.png",)" +
                 camera + R"("rotation_cam_from_world": [[0,-1,0],[1,0,0],[0,0,1]],
             "translation_cam_from_world": [2,-1,-3]}]})");
}

}  // namespace facet_mapping::testing
