// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes with needles and short edges, and measures of what became of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "support/meshes.h"

namespace facet_mapping::test {

inline TriangleMesh make_torus(double radius_m, double tube_m, int around, int across) {
  TriangleMesh mesh;
  const auto vertex = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * M_PI * i / around;
      const double v = 2.0 * M_PI * j / across;
      const double r = radius_m + tube_m * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), tube_m * std::sin(v));
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

/// Pulls some vertices inside the surface close to one of their neighbours, no two that are joined,
/// so that nothing folds over; labels by the sign of x, the other attributes by the label.
inline TriangleMesh ill_shaped(TriangleMesh mesh, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> pull(0.5, 0.95);
  const Adjacency rings = vertex_neighbours(mesh);
  const Adjacency facets = vertex_facets(mesh);
  std::vector<bool> taken(mesh.vertices.size(), false);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const bool inside = rings.size(v) == facets.size(v);
    if (inside && !taken[v] && random() % 4 == 0) {
      const std::uint32_t other = rings.begin(v)[random() % rings.size(v)];
      mesh.vertices[v] += pull(random) * (mesh.vertices[other] - mesh.vertices[v]);
      for (const std::uint32_t* n = rings.begin(v); n != rings.end(v); ++n) {
        taken[*n] = true;
      }
    }
  }
  for (const Triangle& t : mesh.triangles) {
    const double x = mesh.vertices[t[0]].x() + mesh.vertices[t[1]].x() + mesh.vertices[t[2]].x();
    mesh.labels.push_back(x > 0.0 ? 3 : 7);
    mesh.confidence.push_back(x > 0.0 ? 0.25F : 0.75F);
    mesh.views.push_back(x > 0.0 ? 2 : 5);
  }
  return mesh;
}

/// The smallest angle of each facet, degrees, ascending.
inline std::vector<double> sorted_angles_deg(const TriangleMesh& mesh) {
  std::vector<double> angles;
  for (const Triangle& t : mesh.triangles) {
    double smallest = M_PI;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]];
      const Eigen::Vector3d b = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
    angles.push_back(smallest * 180.0 / M_PI);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

inline long count_below(const std::vector<double>& sorted, double limit) {
  return std::lower_bound(sorted.begin(), sorted.end(), limit) - sorted.begin();
}

/// Vertices - edges + facets.
inline long euler_characteristic(const TriangleMesh& mesh) {
  const Adjacency rings = vertex_neighbours(mesh);
  return static_cast<long>(mesh.vertices.size()) - static_cast<long>(rings.items.size() / 2) +
         static_cast<long>(mesh.triangles.size());
}

/// The longest mean edge length around a vertex.
inline double longest_local_length(const TriangleMesh& mesh) {
  const Adjacency rings = vertex_neighbours(mesh);
  double longest = 0.0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    double sum = 0.0;
    for (const std::uint32_t* n = rings.begin(v); n != rings.end(v); ++n) {
      sum += (mesh.vertices[*n] - mesh.vertices[v]).norm();
    }
    longest = std::max(longest, sum / static_cast<double>(std::max<std::size_t>(1, rings.size(v))));
  }
  return longest;
}

inline double segment_distance(const Eigen::Vector3d& p,
                               const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b) {
  const double at = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + at * (b - a) - p).norm();
}

inline double facet_distance(const Eigen::Vector3d& p, const TriangleMesh& mesh, std::size_t f) {
  const Triangle& t = mesh.triangles[f];
  const Eigen::Vector3d normal = facet_cross(mesh, f).normalized();
  bool above = true;
  double distance = 1e300;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& a = mesh.vertices[t[k]];
    const Eigen::Vector3d& b = mesh.vertices[t[(k + 1) % 3]];
    above = above && normal.dot((b - a).cross(p - a)) >= 0.0;
    distance = std::min(distance, segment_distance(p, a, b));
  }
  return above ? std::abs(normal.dot(p - mesh.vertices[t[0]])) : distance;
}

struct Nearest {
  std::size_t facet = 0;
  double distance = 1e300;
};

inline Nearest nearest_facet(const Eigen::Vector3d& p, const TriangleMesh& mesh) {
  Nearest nearest;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const double distance = facet_distance(p, mesh, f);
    if (distance < nearest.distance) {
      nearest = {f, distance};
    }
  }
  return nearest;
}

/// The largest distance of corners, side middles and centres of `from` to the surface `to`.
inline double one_way_distance(const TriangleMesh& from, const TriangleMesh& to) {
  double largest = 0.0;
  for (const Triangle& t : from.triangles) {
    const std::array<Eigen::Vector3d, 3> x = {
        from.vertices[t[0]], from.vertices[t[1]], from.vertices[t[2]]};
    for (const Eigen::Vector3d& p : {x[0],
                                     Eigen::Vector3d((x[0] + x[1]) / 2.0),
                                     Eigen::Vector3d((x[1] + x[2]) / 2.0),
                                     Eigen::Vector3d((x[2] + x[0]) / 2.0),
                                     Eigen::Vector3d((x[0] + x[1] + x[2]) / 3.0)}) {
      largest = std::max(largest, nearest_facet(p, to).distance);
    }
  }
  return largest;
}

using Segment = std::array<Eigen::Vector3d, 2>;

/// Edges with one facet, or with facets of two labels.
inline std::vector<Segment> border_segments(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Label>> edges;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (int k = 0; k < 3; ++k) {
      edges[std::minmax(t[k], t[(k + 1) % 3])].push_back(mesh.labels[f]);
    }
  }
  std::vector<Segment> segments;
  for (const auto& [edge, labels] : edges) {
    if (labels.size() == 1 || labels[0] != labels[1]) {
      segments.push_back({mesh.vertices[edge.first], mesh.vertices[edge.second]});
    }
  }
  return segments;
}

/// The largest distance of a segment's ends and middle to the other segments.
inline double one_way_distance(const std::vector<Segment>& from, const std::vector<Segment>& to) {
  double largest = 0.0;
  for (const Segment& s : from) {
    for (const Eigen::Vector3d& p : {s[0], s[1], Eigen::Vector3d((s[0] + s[1]) / 2.0)}) {
      double nearest = 1e300;
      for (const Segment& other : to) {
        nearest = std::min(nearest, segment_distance(p, other[0], other[1]));
      }
      largest = std::max(largest, nearest);
    }
  }
  return largest;
}

}  // namespace facet_mapping::test
