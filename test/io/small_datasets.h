// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Tiny dataset folders of every layout, three frames of 8x6 pixels.
#pragma once

#include <string>

namespace facet_mapping::testing {

constexpr int kFrames = 3;
constexpr int kWidth = 8;
constexpr int kHeight = 6;

/// "000002" for (2, 6).
std::string padded(int number, int digits);

/// left/ right/ labels/ gt_label/ gt_depth/ velodyne/ calib.txt poses.txt times.txt; K = 10 0 4 / 0
/// 10 3, baseline 0.5 m, one metre forward per frame.
void make_plain(const std::string& folder);

/// The same as image_2/, image_3/ ..., camera 2 standing 0.06 m left of the pose camera (x =
/// -0.06).
void make_odometry(const std::string& folder);

/// A day folder with one drive; returns the drive's folder. The car drives 1 m east per frame, the
/// camera looks along the car.
std::string make_raw(const std::string& day);

/// cameras.json with two views at (0, 0, 0) and (1, 2, 3), images as PNG.
void make_strecha(const std::string& folder);

}  // namespace facet_mapping::testing
