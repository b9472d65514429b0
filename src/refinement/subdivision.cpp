// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/subdivision.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "edge_table.h"
#include <Eigen/Geometry>

namespace facet_mapping {
namespace {

constexpr std::uint32_t kNotSplit = 0xFFFFFFFF;

/// One round of splitting: which edges, and the vertex in the middle of each.
class SplitRound {
 public:
  explicit SplitRound(const TriangleMesh& mesh) : mesh_(mesh), table_(mesh) {
    squared_length_.reserve(table_.edges.size());
    for (const auto& [a, b] : table_.edges) {
      squared_length_.push_back((mesh.vertices[a] - mesh.vertices[b]).squaredNorm());
    }
    marked_.assign(table_.edges.size(), 0);
  }

  /// Marks the long sides of every facet above the limit; false if there is none.
  bool mark(const std::vector<double>& pixels, double limit) {
    constexpr double kLongShare = 0.5;  // of the longest side, squared lengths
    constexpr double kRounding = 1e-9;  // shares are often just the limit: half of twice as much
    bool any = false;
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      if (pixels[f] <= (1.0 + kRounding) * limit) {
        continue;
      }
      const double longest = squared_length_[longest_edge(f)];
      for (const std::uint32_t e : table_.of_facet[f]) {
        marked_[e] |= squared_length_[e] >= kLongShare * longest ? 1 : 0;
      }
      any = true;
    }
    return any;
  }

  /// Marks the longest edge of every facet with a marked edge until nothing changes.
  void propagate() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
        const std::array<std::uint32_t, 3>& edges = table_.of_facet[f];
        const std::uint32_t longest = longest_edge(f);
        if (marked_[longest] == 0 &&
            (marked_[edges[0]] != 0 || marked_[edges[1]] != 0 || marked_[edges[2]] != 0)) {
          marked_[longest] = 1;
          changed = true;
        }
      }
    }
  }

  void number_middles() {
    middle_.assign(table_.edges.size(), kNotSplit);
    auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (std::size_t e = 0; e < middle_.size(); ++e) {
      middle_[e] = marked_[e] != 0 ? next++ : kNotSplit;
    }
  }

  /// The points of the vertices and, behind them, of the middles; none if there are none.
  std::vector<Eigen::Vector3d> with_middles(std::vector<Eigen::Vector3d> points) const {
    for (std::size_t e = 0; e < middle_.size() && !points.empty(); ++e) {
      if (middle_[e] != kNotSplit) {
        const auto [a, b] = table_.edges[e];
        points.emplace_back(0.5 * (points[a] + points[b]));
      }
    }
    return points;
  }

  /// Middle vertices of a facet's sides, kNotSplit where a side stays.
  std::array<std::uint32_t, 3> middles(std::size_t facet) const {
    const std::array<std::uint32_t, 3>& edges = table_.of_facet[facet];
    return {middle_[edges[0]], middle_[edges[1]], middle_[edges[2]]};
  }

 private:
  /// Ties go to the smaller id, so that both facets of an edge agree.
  std::uint32_t longest_edge(std::size_t facet) const {
    const std::array<std::uint32_t, 3>& edges = table_.of_facet[facet];
    return *std::max_element(edges.begin(), edges.end(), [this](std::uint32_t a, std::uint32_t b) {
      return std::make_pair(squared_length_[a], b) < std::make_pair(squared_length_[b], a);
    });
  }

  const TriangleMesh& mesh_;
  EdgeTable table_;
  std::vector<double> squared_length_;
  std::vector<std::uint8_t> marked_;
  std::vector<std::uint32_t> middle_;
};

double squared_distance(const std::vector<Eigen::Vector3d>& x, std::uint32_t a, std::uint32_t b) {
  return (x[a] - x[b]).squaredNorm();
}

/// Facet (a, b, c) with the middles of b-c and c-a: a corner and a quadrilateral, which is cut
/// along its shorter diagonal.
void split_two(const std::vector<Eigen::Vector3d>& vertices,
               const Triangle& t,
               std::uint32_t bc,
               std::uint32_t ca,
               std::vector<Triangle>* children) {
  children->push_back({bc, t[2], ca});
  if (squared_distance(vertices, t[0], bc) <= squared_distance(vertices, t[1], ca)) {
    children->push_back({t[0], t[1], bc});
    children->push_back({t[0], bc, ca});
  } else {
    children->push_back({t[0], t[1], ca});
    children->push_back({t[1], bc, ca});
  }
}

/// The children of a facet, all with the parent's orientation.
std::vector<Triangle> split_facet(const std::vector<Eigen::Vector3d>& vertices,
                                  const Triangle& t,
                                  const std::array<std::uint32_t, 3>& middles) {
  std::vector<Triangle> children;
  const auto count = std::count(middles.begin(), middles.end(), kNotSplit);
  if (count == 3) {
    return {t};
  }
  if (count == 0) {
    return {{t[0], middles[0], middles[2]},
            {middles[0], t[1], middles[1]},
            {middles[2], middles[1], t[2]},
            {middles[0], middles[1], middles[2]}};
  }
  for (int side = 0; side < 3; ++side) {
    const int next = (side + 1) % 3;
    const int last = (side + 2) % 3;
    if (count == 2 && middles[side] != kNotSplit) {
      return {{t[side], middles[side], t[last]}, {middles[side], t[next], t[last]}};
    }
    if (count == 1 && middles[side] == kNotSplit) {
      split_two(vertices, {t[side], t[next], t[last]}, middles[next], middles[last], &children);
    }
  }
  return children;
}

double area(const std::vector<Eigen::Vector3d>& x, const Triangle& t) {
  return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).norm();
}

template <typename T>
void carry(const std::vector<T>& from, std::size_t facet, std::vector<T>* to) {
  if (!from.empty()) {
    to->push_back(from[facet]);
  }
}

/// What goes with the facets while they are split.
struct FacetTags {
  std::vector<double> pixels;
  std::vector<std::uint32_t> parents;  ///< facet of the mesh at the start
};

void split_round(SplitRound* round, TriangleMesh* mesh, FacetTags* tags) {
  TriangleMesh finer;
  FacetTags finer_tags;
  round->number_middles();
  finer.vertices = round->with_middles(mesh->vertices);
  finer.start_points = round->with_middles(mesh->start_points);
  for (std::size_t f = 0; f < mesh->triangles.size(); ++f) {
    const double whole = area(finer.vertices, mesh->triangles[f]);
    for (const Triangle& child :
         split_facet(finer.vertices, mesh->triangles[f], round->middles(f))) {
      finer.triangles.push_back(child);
      const double share = whole > 0.0 ? area(finer.vertices, child) / whole : 0.0;
      finer_tags.pixels.push_back(share * tags->pixels[f]);
      finer_tags.parents.push_back(tags->parents[f]);
      carry(mesh->labels, f, &finer.labels);
      carry(mesh->confidence, f, &finer.confidence);
      carry(mesh->views, f, &finer.views);
    }
  }
  *mesh = std::move(finer);
  *tags = std::move(finer_tags);
}

}  // namespace

std::vector<double> best_view_pixels(const TriangleMesh& mesh,
                                     const std::vector<SurfaceView>& surfaces) {
  std::vector<double> best(mesh.triangles.size(), 0.0);
  std::vector<int> count(mesh.triangles.size());
  for (const SurfaceView& surface : surfaces) {
    std::fill(count.begin(), count.end(), 0);
    const cv::Mat& facets = surface.image.facets;
    for (int y = 0; y < facets.rows; ++y) {
      for (int x = 0; x < facets.cols; ++x) {
        const int facet = facets.at<int>(y, x);
        if (facet >= 0) {
          ++count[facet];
        }
      }
    }
    for (std::size_t f = 0; f < best.size(); ++f) {
      best[f] = std::max(best[f], static_cast<double>(count[f]));
    }
  }
  return best;
}

TriangleMesh subdivide(const TriangleMesh& mesh,
                       const std::vector<double>& pixels,
                       double limit,
                       std::vector<std::uint32_t>* parents) {
  if (pixels.size() != mesh.triangles.size() || !(limit > 0.0)) {
    throw std::invalid_argument("subdivide: give one pixel count per facet and a positive limit");
  }
  constexpr int kMaxRounds = 20;
  TriangleMesh finer = mesh;
  FacetTags tags{pixels, std::vector<std::uint32_t>(pixels.size())};
  std::iota(tags.parents.begin(), tags.parents.end(), 0);
  for (int k = 0; k < kMaxRounds; ++k) {
    SplitRound round(finer);
    if (!round.mark(tags.pixels, limit)) {
      break;
    }
    round.propagate();
    split_round(&round, &finer, &tags);
  }
  if (parents != nullptr) {
    *parents = std::move(tags.parents);
  }
  return finer;
}

}  // namespace facet_mapping
