// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pixel_scatter.h"

#include <Eigen/Geometry>

namespace facet_mapping {

Eigen::Vector3d barycentric_weights(const TriangleMesh& mesh,
                                    std::size_t facet,
                                    const Eigen::Vector3d& center,
                                    const Eigen::Vector3d& ray) {
  const Triangle& t = mesh.triangles[facet];
  const Eigen::Vector3d a = mesh.vertices[t[0]] - center;
  const Eigen::Vector3d b = mesh.vertices[t[1]] - center;
  const Eigen::Vector3d c = mesh.vertices[t[2]] - center;
  const Eigen::Vector3d weights(ray.dot(b.cross(c)), ray.dot(c.cross(a)), ray.dot(a.cross(b)));
  return weights / weights.sum();
}

void scatter_to_vertices(const TriangleMesh& mesh,
                         const std::vector<Eigen::Vector3d>& normals,
                         const View& view,
                         const FacetImage& image,
                         const cv::Mat& force,
                         const cv::Mat& curvature,
                         VertexField* field) {
  const Eigen::Vector3d center = view.center();
  for (int y = 0; y < image.facets.rows; ++y) {
    for (int x = 0; x < image.facets.cols; ++x) {
      const double f = force.at<float>(y, x);
      const double h = curvature.at<float>(y, x);
      const int facet = image.facets.at<int>(y, x);
      if (facet < 0 || (f == 0.0 && h == 0.0)) {
        continue;
      }
      const Eigen::Vector3d ray = view.world_from_cam.linear() *
                                  view.camera.ray({static_cast<double>(x), static_cast<double>(y)});
      const Eigen::Vector3d phi = barycentric_weights(mesh, facet, center, ray);
      for (int corner = 0; corner < 3; ++corner) {
        field->add(
            mesh.triangles[facet][corner], phi[corner] * f * normals[facet], phi[corner] * h);
      }
    }
  }
}

}  // namespace facet_mapping
