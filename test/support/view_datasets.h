// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The same three cameras in every layout of single images.
#pragma once

#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "support/small_datasets.h"

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping::testing {

/// Different sizes, focal lengths and poses, one turned by more than half a turn.
inline std::vector<View> three_views() {
  std::vector<View> views(3);
  for (int k = 0; k < 3; ++k) {
    View& view = views[static_cast<std::size_t>(k)];
    view.camera = {kWidth + 2 * k, kHeight, 10.0 + k / 3.0, 11.0 - k / 7.0, 3.6 + k, 2.4 + 0.1 * k};
    const Eigen::Vector3d axis(0.3, 1.0 - k, 0.2 + k);
    view.world_from_cam = Eigen::AngleAxisd(-0.7 + 2.3 * k, axis.normalized());
    view.world_from_cam.translation() = Eigen::Vector3d(100.0 * k - 30.0, 7.0 / 3.0, -5.0);
  }
  return views;
}

inline std::ostringstream exact_stream() {
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  return text;
}

inline Eigen::Matrix3d matrix_of(const PinholeCamera& camera) {
  Eigen::Matrix3d matrix;
  matrix << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  return matrix;
}

template <typename Matrix>
std::string rows_of(const Matrix& matrix) {
  std::ostringstream text = exact_stream();
  const Eigen::IOFormat format(Eigen::FullPrecision, Eigen::DontAlignCols, " ", "\n");
  text << matrix.format(format) << "\n";
  return text.str();
}

inline void write_image_of(const PinholeCamera& camera, const std::string& path) {
  write_image(path, cv::Mat(camera.height, camera.width, CV_8U, cv::Scalar(7)));
}

inline void make_strecha(const std::string& folder, const std::vector<View>& views) {
  std::ostringstream text = exact_stream();
  const Eigen::IOFormat rows(Eigen::FullPrecision, Eigen::DontAlignCols, ",", ",", "[", "]");
  for (std::size_t k = 0; k < views.size(); ++k) {
    const PinholeCamera& camera = views[k].camera;
    const Eigen::Isometry3d pose = views[k].cam_from_world();
    const std::string image = "images/" + padded(static_cast<int>(k), 4) + ".png";
    write_image_of(camera, folder + "/" + image);
    text << (k > 0 ? "," : "{\"views\": [") << "{\"image\": \"" << image
         << "\", \"width\": " << camera.width << ", \"height\": " << camera.height
         << ", \"fx\": " << camera.fx << ", \"fy\": " << camera.fy << ", \"cx\": " << camera.cx
         << ", \"cy\": " << camera.cy << ", \"rotation_cam_from_world\": ["
         << pose.linear().format(rows) << "], \"translation_cam_from_world\": ["
         << pose.translation().transpose().format(
                Eigen::IOFormat(Eigen::FullPrecision, Eigen::DontAlignCols, ","))
         << "]}";
  }
  write_text(folder + "/cameras.json", text.str() + "]}");
}

/// cameras.txt and images.txt of views with these image names. The last image comes first in the
/// tables, the first one has no 2D points.
inline void write_colmap_model(const std::string& folder,
                               const std::vector<View>& views,
                               const std::vector<std::string>& names) {
  std::ostringstream cameras = exact_stream();
  std::ostringstream images = exact_stream();
  cameras << "# Camera list with one line of data per camera:\n# Number of cameras: 3\n";
  images << "# Image list with two lines of data per image:\n# Number of images: " << views.size()
         << ", mean observations per image: 1\n";
  for (std::size_t k = views.size(); k-- > 0;) {
    const PinholeCamera& camera = views[k].camera;
    const Eigen::Isometry3d pose = views[k].cam_from_world();
    const Eigen::Quaterniond turn(pose.linear());
    cameras << 10 + k << " PINHOLE " << camera.width << " " << camera.height << " " << camera.fx
            << " " << camera.fy << " " << camera.cx + 0.5 << " " << camera.cy + 0.5 << "\n";
    images << 7 * k + 1 << " " << turn.w() << " " << turn.x() << " " << turn.y() << " " << turn.z()
           << " " << pose.translation().x() << " " << pose.translation().y() << " "
           << pose.translation().z() << " " << 10 + k << " " << names[k] << "\n"
           << (k == 0 ? "" : "2362.39 248.498 58396 1784.7 268.254 -1") << "\n";
  }
  write_text(folder + "/cameras.txt", cameras.str());
  write_text(folder + "/images.txt", images.str());
}

/// The model lies in folder/`model`, images in folder/images/left.
inline void make_colmap(const std::string& folder,
                        const std::vector<View>& views,
                        const std::string& model = "sparse/0") {
  std::vector<std::string> names;
  for (const View& view : views) {
    names.push_back("left/" + padded(static_cast<int>(names.size()), 4) + ".png");
    write_image_of(view.camera, folder + "/images/" + names.back());
  }
  write_colmap_model(folder + "/" + model, views, names);
}

inline void make_mvsnet(const std::string& folder, const std::vector<View>& views) {
  for (std::size_t k = 0; k < views.size(); ++k) {
    const std::string name = padded(static_cast<int>(k), 8);
    write_image_of(views[k].camera, folder + "/images/" + name + ".jpg");
    write_text(folder + "/cams/" + name + "_cam.txt",
               "extrinsic\n" + rows_of(views[k].cam_from_world().matrix()) + "\nintrinsic\n" +
                   rows_of(matrix_of(views[k].camera)) + "\n425.0 2.5\n");
  }
}

/// rect_001_max.png ... and cal18/pos_001.txt ...; the factor of a projection matrix is free, its
/// sign, too.
inline void make_dtu(const std::string& folder, const std::vector<View>& views) {
  const double factors[] = {1.0, -3.7, 0.02};
  for (std::size_t k = 0; k < views.size(); ++k) {
    const std::string name = padded(static_cast<int>(k) + 1, 3);
    write_image_of(views[k].camera, folder + "/rect_" + name + "_max.png");
    const Eigen::Matrix<double, 3, 4> projection = factors[k % 3] * matrix_of(views[k].camera) *
                                                   views[k].cam_from_world().matrix().topRows<3>();
    write_text(folder + "/cal18/pos_" + name + ".txt", rows_of(projection));
  }
}

}  // namespace facet_mapping::testing
