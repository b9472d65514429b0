// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "facet_mapping/ros/mesh_conversions.h"

namespace facet_mapping {
namespace {

using visualization_msgs::Marker;

struct CellHash {
  std::size_t operator()(const ChunkKey& key) const {
    constexpr std::uint64_t kPrimes[3] = {73856093, 19349663, 83492791};
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      hash ^= static_cast<std::uint64_t>(key[axis]) * kPrimes[axis];
    }
    return hash;
  }
};

/// Joins all vertices in a grid cell into the first of them and drops facets that collapse.
TriangleMesh cluster_vertices(const TriangleMesh& mesh, double cell_m) {
  std::unordered_map<ChunkKey, std::uint32_t, CellHash> first;
  std::vector<std::uint32_t> representative(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    ChunkKey key{};
    for (int axis = 0; axis < 3; ++axis) {
      key[axis] = static_cast<std::int32_t>(std::floor(mesh.vertices[v][axis] / cell_m));
    }
    representative[v] = first.emplace(key, v).first->second;
  }
  TriangleMesh joined = mesh;
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t f = 0; f < joined.triangles.size(); ++f) {
    Triangle& t = joined.triangles[f];
    for (std::uint32_t& v : t) {
      v = representative[v];
    }
    keep[f] = t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
  }
  return select_facets(joined, keep);
}

double total_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    area += 0.5 * facet_cross(mesh, f).norm();
  }
  return area;
}

Marker class_marker(const LabelSet& labels, Label label, const std_msgs::Header& header) {
  Marker marker;
  marker.header = header;
  marker.ns = labels.name_of(label);
  marker.id = label;
  marker.type = Marker::TRIANGLE_LIST;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  const Rgb color = labels.color_of(label);
  marker.color.r = static_cast<float>(color[0]) / 255.0F;
  marker.color.g = static_cast<float>(color[1]) / 255.0F;
  marker.color.b = static_cast<float>(color[2]) / 255.0F;
  marker.color.a = 1.0F;
  return marker;
}

void append_facet(const TriangleMesh& mesh, const Triangle& triangle, Marker* marker) {
  for (const std::uint32_t v : triangle) {
    geometry_msgs::Point point;
    point.x = mesh.vertices[v].x();
    point.y = mesh.vertices[v].y();
    point.z = mesh.vertices[v].z();
    marker->points.push_back(point);
  }
}

Marker delete_marker(const LabelSet& labels, Label label, const std_msgs::Header& header) {
  Marker marker = class_marker(labels, label, header);
  marker.action = Marker::DELETE;
  return marker;
}

}  // namespace

TriangleMesh decimate_for_display(const TriangleMesh& mesh, std::size_t max_triangles) {
  if (mesh.triangles.size() <= max_triangles) {
    return mesh;
  }
  // Start from the edge length of equal triangles that would cover the area just so.
  double cell_m = std::max(1e-3, std::sqrt(total_area(mesh) / static_cast<double>(max_triangles)));
  TriangleMesh coarse = mesh;
  while (coarse.triangles.size() > max_triangles) {
    coarse = cluster_vertices(mesh, cell_m);
    cell_m *= 1.3;
  }
  return coarse;
}

visualization_msgs::MarkerArray markers_from_mesh(const TriangleMesh& mesh,
                                                  const LabelSet& labels,
                                                  const std_msgs::Header& header,
                                                  std::size_t max_triangles,
                                                  std::set<Label>* shown) {
  const TriangleMesh display = decimate_for_display(mesh, max_triangles);
  std::map<Label, Marker> by_class;
  for (std::size_t f = 0; f < display.triangles.size(); ++f) {
    const Label label = display.labels.empty() ? kUnlabelled : display.labels[f];
    auto found = by_class.find(label);
    if (found == by_class.end()) {
      found = by_class.emplace(label, class_marker(labels, label, header)).first;
    }
    append_facet(display, display.triangles[f], &found->second);
  }
  visualization_msgs::MarkerArray array;
  std::set<Label> present;
  for (auto& [label, marker] : by_class) {
    present.insert(label);
    array.markers.push_back(std::move(marker));
  }
  for (const Label label : *shown) {
    if (present.count(label) == 0) {
      array.markers.push_back(delete_marker(labels, label, header));
    }
  }
  *shown = present;
  return array;
}

}  // namespace facet_mapping
