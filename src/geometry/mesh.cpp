// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/geometry/mesh.h"

#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

namespace facet_mapping {
namespace {

void check_attribute(std::size_t size, std::size_t owners, const char* name, const char* owner) {
  if (size != 0 && size != owners) {
    throw std::invalid_argument("mesh: " + std::to_string(size) + " " + name + " for " +
                                std::to_string(owners) + " " + owner + "; give one each or none");
  }
}

void check_finite(const std::vector<Eigen::Vector3d>& points, const char* name) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!points[v].allFinite()) {
      throw std::invalid_argument("mesh: " + std::string(name) + " " + std::to_string(v) +
                                  " is not finite");
    }
  }
}

}  // namespace

void validate(const TriangleMesh& mesh) {
  check_attribute(mesh.labels.size(), mesh.triangles.size(), "labels", "facets");
  check_attribute(mesh.confidence.size(), mesh.triangles.size(), "confidences", "facets");
  check_attribute(mesh.views.size(), mesh.triangles.size(), "view counts", "facets");
  check_attribute(mesh.start_points.size(), mesh.vertices.size(), "start points", "vertices");
  check_finite(mesh.vertices, "vertex");
  check_finite(mesh.start_points, "start point");
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      if (v >= mesh.vertices.size()) {
        throw std::invalid_argument("mesh: facet " + std::to_string(f) + " names vertex " +
                                    std::to_string(v) + " of only " +
                                    std::to_string(mesh.vertices.size()));
      }
    }
  }
}

std::size_t bytes_of(const TriangleMesh& mesh) {
  return bytes_of(mesh.vertices) + bytes_of(mesh.triangles) + bytes_of(mesh.labels) +
         bytes_of(mesh.confidence) + bytes_of(mesh.views) + bytes_of(mesh.start_points);
}

Eigen::Vector3d facet_cross(const TriangleMesh& mesh, std::size_t facet) {
  const Triangle& t = mesh.triangles[facet];
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

std::vector<Eigen::Vector3d> facet_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.triangles.size());
  for (std::size_t f = 0; f < normals.size(); ++f) {
    normals[f] = facet_cross(mesh, f).normalized();
  }
  return normals;
}

std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Eigen::Vector3d cross = facet_cross(mesh, f);
    for (const std::uint32_t v : mesh.triangles[f]) {
      normals[v] += cross;
    }
  }
  for (Eigen::Vector3d& normal : normals) {
    normal.normalize();
  }
  return normals;
}

TriangleMesh select_facets(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  TriangleMesh selected;
  constexpr std::uint32_t kUnused = 0xFFFFFFFF;
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), kUnused);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!keep[f]) {
      continue;
    }
    Triangle triangle = mesh.triangles[f];
    for (std::uint32_t& v : triangle) {
      if (new_index[v] == kUnused) {
        new_index[v] = static_cast<std::uint32_t>(selected.vertices.size());
        selected.vertices.push_back(mesh.vertices[v]);
        if (!mesh.start_points.empty()) {
          selected.start_points.push_back(mesh.start_points[v]);
        }
      }
      v = new_index[v];
    }
    selected.triangles.push_back(triangle);
  }
  selected.labels = select_values(mesh.labels, keep);
  selected.confidence = select_values(mesh.confidence, keep);
  selected.views = select_values(mesh.views, keep);
  return selected;
}

}  // namespace facet_mapping
