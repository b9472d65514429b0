// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

#include "carving/ray_bundle.h"
#include "support/crossed_cells.h"
#include <gtest/gtest.h>

namespace facet_mapping::carving {
namespace {

using testing::meeting;
using testing::Meeting;

/// A cell that two triangulations of the same points can be compared by.
using CellPoints = std::array<Point, 4>;

CellPoints points_of(CellHandle cell) {
  CellPoints points{cell->vertex(0)->point(),
                    cell->vertex(1)->point(),
                    cell->vertex(2)->point(),
                    cell->vertex(3)->point()};
  std::sort(points.begin(), points.end());
  return points;
}

std::vector<CellHandle> walked(const Triangulation& triangulation,
                               VertexHandle start,
                               const Point& target) {
  std::vector<CellHandle> cells;
  for (RayWalk walk(triangulation, start, target); !walk.done(); walk.advance()) {
    cells.push_back(walk.cell());
  }
  return cells;
}

/// Every crossed cell is visited, once, and nothing is visited that the segment does not meet.
void expect_exact(const Triangulation& triangulation, VertexHandle start, const Point& target) {
  const std::vector<CellHandle> cells = walked(triangulation, start, target);
  const std::set<CellHandle> visited(cells.begin(), cells.end());
  EXPECT_EQ(visited.size(), cells.size());
  for (const CellHandle cell : triangulation.finite_cell_handles()) {
    const Meeting met = meeting(start->point(), target, cell);
    EXPECT_FALSE(met == Meeting::kCrosses && visited.count(cell) == 0) << "a cell was missed";
    EXPECT_FALSE(met == Meeting::kApart && visited.count(cell) == 1) << "a cell is not met";
  }
}

std::vector<Point> random_points(std::mt19937* random, int count, double flatness) {
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  std::vector<Point> points;
  for (int k = 0; k < count; ++k) {
    points.emplace_back(uniform(*random), uniform(*random), flatness * uniform(*random));
  }
  return points;
}

/// Points of a small grid: many on one line, plane and sphere.
std::vector<Point> grid_points(int side) {
  std::vector<Point> points;
  for (int k = 0; k < side * side * side; ++k) {
    points.emplace_back(k % side, k / side % side, k / side / side);
  }
  return points;
}

TEST(RayWalk, VisitsExactlyTheCrossedCells) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const std::vector<Point> points = random_points(&random, 50, seed % 2 == 0 ? 1.0 : 1e-3);
    const Triangulation triangulation(points.begin(), points.end());
    std::uniform_real_distribution<double> uniform(-12.0, 12.0);
    for (const VertexHandle vertex : triangulation.finite_vertex_handles()) {
      expect_exact(triangulation, vertex, {uniform(random), uniform(random), uniform(random)});
    }
  }
}

TEST(RayWalk, MeetsEdgesVerticesAndPlanesExactly) {
  const std::vector<Point> points = grid_points(4);
  const Triangulation triangulation(points.begin(), points.end());
  for (const VertexHandle vertex : triangulation.finite_vertex_handles()) {
    for (std::size_t k = vertex->point() < points[32] ? 0 : 1; k < points.size(); k += 2) {
      expect_exact(triangulation, vertex, points[k]);
    }
    expect_exact(triangulation, vertex, {1.5, 1.5, 1.5});
    expect_exact(triangulation, vertex, {2.0, 1.0, 0.5});
    expect_exact(triangulation, vertex, {9.0, 9.0, 9.0});
  }
}

/// The cells of a walk do not tell in which order the points came, on which side of the target the
/// cells were stored, or from which cell of the start the walk began.
TEST(RayWalk, DoesNotDependOnTheTriangulationsHistory) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    // A grid whose spheres are moved a little, so that the triangulation is unique, but whose rows
    // and planes are kept: rays along these meet edges and facets all the way.
    std::vector<Point> points;
    for (const Point& p : grid_points(4)) {
      points.emplace_back(p.x() * p.x() + p.x(), p.y() * p.y() + 2.0 * p.y(), p.z() * 1.75);
    }
    for (const Point& p : random_points(&random, 40, 1.0)) {
      points.push_back(p);
    }
    const Triangulation first(points.begin(), points.end());
    Triangulation second;
    std::shuffle(points.begin(), points.end(), random);
    for (const Point& point : points) {
      second.insert(point);
    }
    for (const VertexHandle vertex : first.finite_vertex_handles()) {
      VertexHandle other;
      ASSERT_TRUE(second.is_vertex(vertex->point(), other));
      const Point& target = points[random() % points.size()];
      std::vector<CellPoints> a;
      std::vector<CellPoints> b;
      for (const CellHandle cell : walked(first, vertex, target)) {
        a.push_back(points_of(cell));
      }
      for (const CellHandle cell : walked(second, other, target)) {
        b.push_back(points_of(cell));
      }
      EXPECT_EQ(a, b);
    }
  }
}

TEST(RayBundle, VisitsTheCellsOfEachRayInItsOrder) {
  std::mt19937 random(5);
  const std::vector<Point> points = random_points(&random, 400, 0.2);
  const Triangulation triangulation(points.begin(), points.end());
  std::vector<VertexHandle> starts;
  std::vector<Point> targets;
  for (const VertexHandle vertex : triangulation.finite_vertex_handles()) {
    starts.push_back(vertex);
    targets.push_back(starts.size() % 10 == 0 ? vertex->point() : points[random() % 400]);
  }
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{5}, starts.size()}) {
    std::vector<std::vector<CellHandle>> cells(count);
    walk_rays(
        triangulation,
        count,
        [&](std::size_t k) { return starts[k]; },
        [&](std::size_t k) { return targets[k]; },
        [&](std::size_t k, const RayWalk& walk) { cells[k].push_back(walk.cell()); });
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_EQ(cells[k], walked(triangulation, starts[k], targets[k]));
    }
  }
}

TEST(RayWalk, ASegmentOfNoLengthCrossesNothing) {
  const std::vector<Point> points = grid_points(3);
  const Triangulation triangulation(points.begin(), points.end());
  const VertexHandle vertex = triangulation.finite_vertices_begin();
  EXPECT_TRUE(RayWalk(triangulation, vertex, vertex->point()).done());
}

TEST(RayWalk, EndsInTheCellOfTheTarget) {
  std::mt19937 random(7);
  const std::vector<Point> points = random_points(&random, 300, 1.0);
  const Triangulation triangulation(points.begin(), points.end());
  const Point target(0.1, 0.2, 0.3);
  const CellHandle home = triangulation.locate(target);
  for (const VertexHandle vertex : triangulation.finite_vertex_handles()) {
    RayWalk walk(triangulation, vertex, target);
    while (!walk.done() && !walk.at_target()) {
      walk.advance();
    }
    ASSERT_FALSE(walk.done());
    EXPECT_EQ(walk.cell(), home);
  }
}

}  // namespace
}  // namespace facet_mapping::carving
