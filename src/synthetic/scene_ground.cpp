// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "noise.h"
#include "scene_parts.h"

namespace facet_mapping {
namespace {

using namespace cross_section;

constexpr double kSegment = 10.0;    // metres of ground per part
constexpr double kCell = 0.5;        // metres of a ground cell along the street
constexpr double kBump = 0.05;       // metres, amplitude of the terrain
constexpr double kEndGround = 16.0;  // metres of ground beyond the road's end

/// Metres from the road's middle of the ground's vertices. All pieces take theirs from here, so
/// that neighbours share their borders and no ray slips through.
constexpr std::array<double, 22> kStations{kRoadHalfWidth,
                                           kRoadHalfWidth + kKerbWidth,
                                           5.75,
                                           6.15,
                                           kStripEnd,
                                           7.2,
                                           8.0,
                                           kPavementEnd,
                                           9.2,
                                           9.7,
                                           10.3,
                                           11.0,
                                           12.0,
                                           13.0,
                                           14.5,
                                           16.0,
                                           18.0,
                                           20.0,
                                           22.0,
                                           24.0,
                                           26.0,
                                           kBackdrop + 1.0};

std::vector<double> stations(double low, double high) {
  std::vector<double> inside;
  std::copy_if(kStations.begin(), kStations.end(), std::back_inserter(inside), [&](double t) {
    return t >= low && t <= high;
  });
  return inside;
}

constexpr int kAcrossRoad = 20;  // cells of the road from side to side

double road_station(int column) {
  return kRoadHalfWidth * (2.0 * column / kAcrossRoad - 1.0);
}

/// From the right backdrop over the road to the left one.
std::vector<double> all_stations() {
  std::vector<double> all;
  for (auto t = kStations.rbegin(); t != kStations.rend(); ++t) {
    all.push_back(-*t);
  }
  for (int column = 1; column < kAcrossRoad; ++column) {
    all.push_back(road_station(column));
  }
  all.insert(all.end(), kStations.begin(), kStations.end());
  return all;
}

/// A piece of the street's ground between two values of s.
struct Segment {
  double begin;
  double end;
  int cells;

  double s(int cell) const { return begin + (end - begin) * cell / cells; }
};

/// Lays strips along the street from station to station of t (metres from the middle).
class GroundLayer {
 public:
  GroundLayer(const Scene& scene, const std::vector<BuildingPlan>& buildings, std::uint32_t seed)
      : scene_(scene), buildings_(buildings), seed_(seed) {}

  void add_road(const Segment& segment) {
    const auto vertex = [&](int row, int column) {
      const double t = road_station(column);
      return at(segment.s(row), t, scene_.line->ground_height(t));
    };
    scene_.builder->add_grid(
        segment.cells, kAcrossRoad, vertex, {street_class::kRoad, scene_.shared.asphalt});
  }

  void add_kerb(const Segment& segment, int side) {
    const double low = scene_.line->ground_height(kRoadHalfWidth);
    const double high = top(kRoadHalfWidth);
    const Surface surface{street_class::kSidewalk, scene_.shared.kerb};
    const auto face = [&](int row, int column) {
      SceneVertex v = at(segment.s(row), side * kRoadHalfWidth, column == 0 ? low : high);
      v.texture = {v.texture.x(), static_cast<float>(column == 0 ? low : high), v.texture.y()};
      return v;
    };
    add_sided(segment.cells, 1, side, face, surface);
    add_strip(segment, side, {kRoadHalfWidth, kRoadHalfWidth + kKerbWidth}, surface);
  }

  void add_strip(const Segment& segment,
                 int side,
                 const std::vector<double>& across,
                 const Surface& surface) {
    const double bump = surface.label == street_class::kTerrain ? kBump : 0.0;
    const auto vertex = [&](int row, int column) {
      const double s = segment.s(row);
      const double t = side * across[column];
      const bool last = column + 1 == static_cast<int>(across.size());
      const bool inner = across.back() < kBackdrop;
      const bool seam = inner ? row == 0 || row == segment.cells : s > scene_.line->end() - 0.1;
      const bool joins = column == 0 || (last && inner) || seam;  // others meet it there
      return at(s, t, top(t) + (joins ? 0.0 : bump_at(s, t, bump)));
    };
    const auto keep = [&](int row, int column) {
      return !is_built(
          segment.s(row), segment.s(row + 1), side * across[column], side * across[column + 1]);
    };
    add_sided(segment.cells, static_cast<int>(across.size()) - 1, side, vertex, surface, keep);
  }

  /// Ground that closes the street beyond the road's end: kerb, pavement, terrain.
  void add_end(double end) {
    const auto face = [&](int row, int column) {
      const double t = road_station(kAcrossRoad - row);
      const double h = column == 0 ? scene_.line->ground_height(t) : top(t);
      SceneVertex v = at(end, t, h);
      v.texture = {static_cast<float>(t), static_cast<float>(h), 0.0F};
      return v;
    };
    scene_.builder->add_grid(kAcrossRoad, 1, face, {street_class::kSidewalk, scene_.shared.kerb});
    add_end_strip(end, end + 2.0, {street_class::kSidewalk, scene_.shared.paving});
    add_end_strip(end + 2.0, end + kEndGround, {street_class::kTerrain, scene_.shared.grass});
  }

 private:
  SceneVertex at(double s, double t, double h) const {
    return {scene_.line->to_map(s, t, h),
            Eigen::Vector3d(s, t, t < 0.0 ? -1.0 : 1.0).cast<float>()};
  }

  /// The pavement's height, also where t is on the road.
  double top(double t) const {
    return scene_.line->ground_height(std::max(std::abs(t), kRoadHalfWidth + 1e-9));
  }

  double bump_at(double s, double t, double amplitude) const {
    if (amplitude == 0.0) {
      return 0.0;
    }
    const Eigen::Vector3f p(static_cast<float>(s), static_cast<float>(t), 0.5F);
    return amplitude * octave_noise(p, 0.4F, 2, 0.01F, seed_);
  }

  /// True if a cell lies inside a building, a little within its walls.
  bool is_built(double s0, double s1, double t0, double t1) const {
    constexpr double kInside = 0.4;
    return std::any_of(buildings_.begin(), buildings_.end(), [&](const BuildingPlan& plan) {
      return t0 * plan.side > plan.front + kInside && t1 * plan.side > plan.front + kInside &&
             std::max(std::abs(t0), std::abs(t1)) < plan.front + plan.depth - kInside &&
             s0 > plan.begin + kInside && s1 < plan.end - kInside;
    });
  }

  /// Rows along the street, columns away from its middle; keeps the upper side outside.
  void add_sided(int rows,
                 int columns,
                 int side,
                 const SceneBuilder::GridVertex& vertex,
                 const Surface& surface,
                 const SceneBuilder::GridCell& keep = {}) {
    if (side > 0) {
      scene_.builder->add_grid(rows, columns, vertex, surface, keep);
      return;
    }
    const auto mirrored = [&](int row, int column) { return vertex(rows - row, column); };
    const auto mirrored_keep = [&](int row, int column) { return keep(rows - row - 1, column); };
    scene_.builder->add_grid(
        rows, columns, mirrored, surface, keep ? SceneBuilder::GridCell(mirrored_keep) : keep);
  }

  void add_end_strip(double begin, double end, const Surface& surface) {
    const std::vector<double> across = all_stations();
    const int cells = static_cast<int>(std::ceil((end - begin) / kCell));
    const double bump = surface.label == street_class::kTerrain ? kBump : 0.0;
    const auto vertex = [&](int row, int column) {
      const double s = begin + (end - begin) * row / cells;
      const double t = across[column];
      return at(s, t, top(t) + (row == 0 ? 0.0 : bump_at(s, t, bump)));
    };
    scene_.builder->add_grid(cells, static_cast<int>(across.size()) - 1, vertex, surface);
  }

  const Scene& scene_;
  const std::vector<BuildingPlan>& buildings_;
  std::uint32_t seed_;
};

void add_segment(GroundLayer* layer, const Scene& scene, const Segment& segment, Random* random) {
  const Surface paving{street_class::kSidewalk, scene.shared.paving};
  const Surface grass{street_class::kTerrain, scene.shared.grass};
  scene.builder->begin_part();
  layer->add_road(segment);
  for (const int side : {1, -1}) {
    scene.builder->begin_part();
    layer->add_kerb(segment, side);
    const Surface& strip = random->chance(0.6) ? grass : paving;
    layer->add_strip(segment, side, stations(kRoadHalfWidth + kKerbWidth, kStripEnd), strip);
    layer->add_strip(segment, side, stations(kStripEnd, kPavementEnd), paving);
    scene.builder->begin_part();
    layer->add_strip(segment, side, stations(kPavementEnd, kStations.back()), grass);
  }
}

}  // namespace

void add_ground(const Scene& scene, const std::vector<BuildingPlan>& buildings, Random* random) {
  GroundLayer layer(scene, buildings, random->bits32());
  const double begin = scene.line->begin();
  const double end = scene.line->end();
  const int count = std::max(1, static_cast<int>(std::lround((end - begin) / kSegment)));
  for (int k = 0; k < count; ++k) {
    Segment segment{begin + (end - begin) * k / count, begin + (end - begin) * (k + 1) / count, 0};
    segment.cells = static_cast<int>(std::ceil((segment.end - segment.begin) / kCell));
    add_segment(&layer, scene, segment, random);
  }
  scene.builder->begin_part();
  layer.add_end(end);
}

}  // namespace facet_mapping
