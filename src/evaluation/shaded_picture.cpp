// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "facet_mapping/evaluation/pictures.h"

namespace facet_mapping {
namespace {

const cv::Vec3b kIvory(205, 222, 230);

// Light on a facet with this unit normal in the camera frame, 0..1: some from everywhere, more from
// above, most from the lamp.
double light_on(const Eigen::Vector3d& normal) {
  static const Eigen::Vector3d lamp = Eigen::Vector3d(-0.45, -0.65, -0.8).normalized();
  return 0.38 + 0.14 * (1.0 - normal.y()) / 2.0 + 0.55 * std::max(0.0, normal.dot(lamp));
}

std::vector<double> facet_lights(const TriangleMesh& mesh, const View& view) {
  const Eigen::Matrix3d cam_from_world = view.world_from_cam.linear().transpose();
  std::vector<Eigen::Vector3d> normals = facet_normals(mesh);
  std::vector<double> lights(normals.size());
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const Eigen::Vector3d to_facet = mesh.vertices[mesh.triangles[f][0]] - view.center();
    const bool is_back = normals[f].dot(to_facet) > 0.0;
    const Eigen::Vector3d normal = cam_from_world * (is_back ? -normals[f] : normals[f]);
    lights[f] = light_on(normal);
  }
  return lights;
}

// 0 in the open to 1 deep in hollows and behind edges: how much farther a pixel is than the mean of
// its surroundings, after Luft et al. 2006 (unsharp masking of the depth buffer), relative to its
// depth.
cv::Mat hollowness(const cv::Mat& depth) {
  cv::Mat seen;
  cv::Mat(depth > 0.0F).convertTo(seen, CV_32F, 1.0 / 255.0);
  cv::Mat logarithm;
  cv::log(cv::max(depth, 1e-3), logarithm);
  logarithm = logarithm.mul(seen);
  const double sigma = std::max(2.0, depth.cols / 80.0);
  cv::Mat mean;
  cv::Mat weight;
  cv::GaussianBlur(logarithm, mean, {}, sigma);
  cv::GaussianBlur(seen, weight, {}, sigma);
  mean /= cv::max(weight, 1e-3);
  constexpr double kFullDark = 0.12;  // this much farther than the surroundings, relative
  cv::Mat hollow = (logarithm - mean) / kFullDark;
  return cv::min(cv::max(hollow, 0.0), 1.0);
}

cv::Vec3b base_color(const TriangleMesh& mesh, const LabelSet& labels, std::size_t facet) {
  if (mesh.labels.empty()) {
    return kIvory;
  }
  const Rgb rgb = labels.color_of(mesh.labels[facet]);
  return {rgb[2], rgb[1], rgb[0]};
}

}  // namespace

cv::Mat shaded_picture(const FacetImage& image,
                       const TriangleMesh& mesh,
                       const LabelSet& labels,
                       const View& view) {
  const std::vector<double> lights = facet_lights(mesh, view);
  const cv::Mat hollow = hollowness(image.depth);
  cv::Mat picture(image.facets.size(), CV_8UC3, cv::Scalar(255, 255, 255));
  constexpr double kDarkening = 0.45;
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const int facet = image.facets.at<int>(row, column);
      if (facet < 0) {
        continue;
      }
      const auto f = static_cast<std::size_t>(facet);
      const double light = lights.at(f) * (1.0 - kDarkening * hollow.at<float>(row, column));
      const cv::Vec3b color = base_color(mesh, labels, f);
      for (int channel = 0; channel < 3; ++channel) {
        // Class colours are often dark: a little of white lets their shape be seen.
        picture.at<cv::Vec3b>(row, column)[channel] =
            cv::saturate_cast<unsigned char>(light * (0.8 * color[channel] + 60.0));
      }
    }
  }
  return picture;
}

}  // namespace facet_mapping
