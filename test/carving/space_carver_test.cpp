// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/carving/space_carver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping {
namespace {

/// A sensor inside a box room of 8 x 6 x 4 m that sees points on its walls; the wall's number is
/// the label.
CarvingFrame look_around(const Eigen::Vector3d& center, int rays, double noise_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d half(4.0, 3.0, 2.0);
  CarvingFrame frame;
  frame.center = center;
  for (int k = 0; k < rays; ++k) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    double length = std::numeric_limits<double>::infinity();
    Label wall = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double side = direction[axis] > 0.0 ? half[axis] : -half[axis];
      const double reach = (side - center[axis]) / direction[axis];
      if (reach < length) {
        length = reach;
        wall = static_cast<Label>(2 * axis + (side > 0.0 ? 1 : 0));
      }
    }
    const Eigen::Vector3d point = center + direction * (length + noise_m * normal(random));
    frame.rays.push_back({point, wall, static_cast<float>(noise_m)});
  }
  return frame;
}

Label nearest_wall(const Eigen::Vector3d& point) {
  const Eigen::Vector3d gap = Eigen::Vector3d(4.0, 3.0, 2.0) - point.cwiseAbs();
  int axis = 0;
  gap.minCoeff(&axis);
  return static_cast<Label>(2 * axis + (point[axis] > 0.0 ? 1 : 0));
}

CarvingConfig room_config() {
  CarvingConfig config;
  config.steiner_spacing_m = 3.0;
  config.steiner_reach_m = 12.0;
  return config;
}

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  }
  return sum;
}

TEST(SpaceCarver, CarvesARoom) {
  SpaceCarver carver(room_config());
  carver.insert({look_around({0.5, 0.2, 0.1}, 3000, 0.0, 1)});
  const TriangleMesh mesh = carver.extract_surface().mesh;
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold()) << check_manifold(mesh).to_string();
  EXPECT_NEAR(volume(mesh), -192.0, 4.0);
}

TEST(SpaceCarver, CarvesARoomWithoutLabels) {
  SpaceCarver carver(room_config());
  CarvingFrame frame = look_around({0.5, 0.2, 0.1}, 3000, 0.0, 1);
  for (CarvingFrame::Ray& ray : frame.rays) {
    ray.label = kUnlabelled;
  }
  carver.insert({frame});
  const TriangleMesh mesh = carver.extract_surface().mesh;
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold());
  EXPECT_NEAR(volume(mesh), -192.0, 4.0);
  for (const Label label : mesh.labels) {
    ASSERT_EQ(label, kUnlabelled);
  }
}

TEST(SpaceCarver, OpenRaysCarveButLeaveNoSurface) {
  SpaceCarver carver(room_config());
  CarvingFrame frame = look_around({0.0, 0.0, 0.0}, 3000, 0.0, 1);
  for (CarvingFrame::Ray& ray : frame.rays) {
    ray.open = ray.label == 5;  // the ceiling is the sky
  }
  carver.insert({frame});
  const TriangleMesh mesh = carver.extract_surface().mesh;
  std::size_t walls = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    EXPECT_NE(mesh.labels[f], 5);
    walls += mesh.views[f] > 0 ? 1 : 0;
    for (const std::uint32_t v : mesh.triangles[f]) {
      EXPECT_FALSE(mesh.views[f] > 0 && mesh.vertices[v].z() > 1.999);
    }
  }
  EXPECT_GT(walls, 1000U);
}

/// The cells with all corners within 20 m of a point.
std::vector<CellEvidence> cells_near(const SpaceCarver& carver, const Eigen::Vector3d& point) {
  std::vector<CellEvidence> cells = carver.evidence();
  const auto is_far = [&point](const CellEvidence& cell) {
    return std::any_of(cell.vertices.begin(), cell.vertices.end(), [&point](const auto& corner) {
      return (corner - point).norm() > 20.0;
    });
  };
  cells.erase(std::remove_if(cells.begin(), cells.end(), is_far), cells.end());
  return cells;
}

TEST(SpaceCarver, ForgetsWhatIsFarAndKeepsTheEvidenceNearby) {
  CarvingConfig config;
  config.steiner_reach_m = 20.0;
  SpaceCarver all(config);
  SpaceCarver bounded(config);
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (unsigned k = 0; k < 12; ++k) {  // a row of rooms, 9 m apart
    place = Eigen::Vector3d(9.0 * k, 0.0, 0.0);
    CarvingFrame frame = look_around({0.0, 0.0, 0.0}, 400, 0.02, k);
    frame.center += place;
    for (CarvingFrame::Ray& ray : frame.rays) {
      ray.point += place;
    }
    const FrameId id = all.insert({frame}).front();
    EXPECT_EQ(bounded.insert({frame}).front(), id);
    bounded.forget_beyond(place, 35.0);
    EXPECT_TRUE(check_manifold(bounded.extract_surface().mesh).is_closed_manifold());
  }
  EXPECT_FALSE(bounded.holds(0));
  EXPECT_TRUE(bounded.holds(11));
  EXPECT_LT(bounded.stats().vertices, all.stats().vertices);
  EXPECT_LT(bounded.bytes(), all.bytes());
  EXPECT_GT(cells_near(all, place).size(), 1000U);
  EXPECT_TRUE(cells_near(bounded, place) == cells_near(all, place));
}

TEST(SpaceCarver, LabelsTheWalls) {
  SpaceCarver carver(room_config());
  carver.insert({look_around({0.0, 0.0, 0.0}, 3000, 0.0, 2)});
  const TriangleMesh mesh = carver.extract_surface().mesh;
  double right = 0.0;
  double total = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const Eigen::Vector3d centroid =
        (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    const double area = facet_cross(mesh, f).norm();
    total += area;
    right += mesh.labels[f] == nearest_wall(centroid) ? area : 0.0;
  }
  EXPECT_GT(right / total, 0.95);
}

TEST(SpaceCarver, NoiseDoesNotOpenTheWalls) {
  SpaceCarver carver(room_config());
  for (unsigned seed = 0; seed < 5; ++seed) {
    carver.insert({look_around({0.2 * seed, 0.1 * seed, 0.0}, 1500, 0.03, seed)});
  }
  const TriangleMesh mesh = carver.extract_surface().mesh;
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold());
  EXPECT_NEAR(volume(mesh), -192.0, 12.0);
}

class RandomRooms : public testing::TestWithParam<unsigned> {};

TEST_P(RandomRooms, EverySurfaceIsAClosedManifold) {
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  SpaceCarver carver(room_config());
  for (int batch = 0; batch < 4; ++batch) {
    std::vector<CarvingFrame> frames;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d center(uniform(random), uniform(random), uniform(random));
      frames.push_back(look_around(center, 150, 0.3, random()));
    }
    carver.insert(frames);
    const CarvedSurface surface = carver.extract_surface();
    const ManifoldReport report = check_manifold(surface.mesh);
    EXPECT_TRUE(report.is_closed_manifold()) << "seed " << GetParam() << ": " << report.to_string();
    EXPECT_GT(surface.mesh.triangles.size(), 20U);
    EXPECT_LE(carver.stats().reached_cells, carver.stats().free_cells);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRooms, testing::Range(0U, 40U));

TEST(SpaceCarver, IncrementalEvidenceEqualsBatchEvidence) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<CarvingFrame> frames;
    for (unsigned k = 0; k < 6; ++k) {
      frames.push_back(look_around({0.3 * k - 0.7, 0.1 * k, 0.05 * k}, 200, 0.1, 100 * seed + k));
    }
    SpaceCarver batch(room_config());
    batch.insert(frames);
    SpaceCarver incremental(room_config());
    for (const CarvingFrame& frame : frames) {
      incremental.insert({frame});
    }
    EXPECT_TRUE(incremental.evidence() == batch.evidence()) << "seed " << seed;
  }
}

/// Random insertions, removals and moves of frames, several in one batch at times.
class RandomHistories : public testing::TestWithParam<unsigned> {
 protected:
  struct Held {
    FrameId id;
    CarvingFrame frame;
  };

  CarvingFrame random_frame() {
    const Eigen::Vector3d center(uniform_(random_), uniform_(random_), 0.7 * uniform_(random_));
    const int rays = static_cast<int>(random_() % 60);
    return look_around(center, rays, 0.05 + 0.25 * std::abs(uniform_(random_)), random_());
  }

  void step(SpaceCarver* carver) {
    std::vector<FrameId> removed;
    std::vector<CarvingFrame> added;
    for (unsigned k = random_() % 3; k > 0 && !held_.empty(); --k) {
      const auto at = held_.begin() + static_cast<std::ptrdiff_t>(random_() % held_.size());
      removed.push_back(at->id);
      if (random_() % 2 == 0) {
        CarvingFrame moved = at->frame;
        const Eigen::Vector3d shift =
            0.2 * Eigen::Vector3d(uniform_(random_), uniform_(random_), 0);
        moved.center += shift;
        for (CarvingFrame::Ray& ray : moved.rays) {
          ray.point += shift;
        }
        added.push_back(moved);
      }
      held_.erase(at);
    }
    for (unsigned k = random_() % 3; k > 0; --k) {
      added.push_back(random_frame());
    }
    const std::vector<FrameId> ids = carver->update(removed, added);
    ASSERT_EQ(ids.size(), added.size());
    for (std::size_t k = 0; k < ids.size(); ++k) {
      held_.push_back({ids[k], added[k]});
    }
  }

  std::vector<CellEvidence> batch_evidence(const CarvingConfig& config) const {
    std::vector<CarvingFrame> frames;
    for (const Held& held : held_) {
      frames.push_back(held.frame);
    }
    SpaceCarver batch(config);
    batch.insert(frames);
    return batch.evidence();
  }

  std::mt19937 random_{GetParam()};
  std::uniform_real_distribution<double> uniform_{-1.5, 1.5};
  std::vector<Held> held_;
};

TEST_P(RandomHistories, EvidenceIsThatOfOneBatchAndTheSurfaceIsManifold) {
  CarvingConfig config = room_config();
  config.extraction = GetParam() % 2 == 0 ? Extraction::kGraphCut : Extraction::kCount;
  if (GetParam() % 5 == 0) {
    config.steiner_spacing_m = 0.0;
  }
  SpaceCarver carver(config);
  for (int k = 0; k < 10; ++k) {
    step(&carver);
    ASSERT_TRUE(carver.evidence() == batch_evidence(config))
        << "seed " << GetParam() << " step " << k;
    const ManifoldReport report = check_manifold(carver.extract_surface().mesh);
    ASSERT_TRUE(report.is_closed_manifold()) << "seed " << GetParam() << ": " << report.to_string();
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomHistories, testing::Range(0U, 200U));

TEST(SpaceCarver, SameInputSameMesh) {
  const auto run = [] {
    SpaceCarver carver(room_config());
    carver.insert({look_around({0.0, 0.0, 0.0}, 500, 0.1, 3)});
    carver.insert({look_around({1.0, 0.0, 0.0}, 500, 0.1, 4)});
    return carver.extract_surface();
  };
  const CarvedSurface first = run();
  const CarvedSurface second = run();
  EXPECT_EQ(first.mesh.triangles, second.mesh.triangles);
  EXPECT_EQ(first.mesh.labels, second.mesh.labels);
  EXPECT_EQ(first.vertex_ids, second.vertex_ids);
}

TEST(SpaceCarver, NothingGivesNothing) {
  SpaceCarver carver(room_config());
  EXPECT_TRUE(carver.extract_surface().mesh.empty());
  carver.insert({});
  carver.insert({CarvingFrame{}});
  EXPECT_TRUE(carver.extract_surface().mesh.empty());
}

TEST(SpaceCarver, WorksWithoutExtraVertices) {
  CarvingConfig config = room_config();
  config.steiner_spacing_m = 0.0;
  SpaceCarver carver(config);
  CarvingFrame one = look_around({0.0, 0.0, 0.0}, 2, 0.0, 5);
  carver.insert({one});
  EXPECT_TRUE(carver.extract_surface().mesh.empty());
  carver.insert({look_around({0.0, 0.0, 0.0}, 500, 0.0, 6)});
  const TriangleMesh mesh = carver.extract_surface().mesh;
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold());
  EXPECT_NEAR(volume(mesh), -180.0, 15.0);
}

TEST(SpaceCarver, RefusesPointsThatAreNotFinite) {
  SpaceCarver carver(room_config());
  CarvingFrame frame = look_around({0.0, 0.0, 0.0}, 10, 0.0, 7);
  frame.rays[3].point.x() = std::nan("");
  EXPECT_THROW(carver.insert({frame}), std::invalid_argument);
  frame = look_around({0.0, 0.0, 0.0}, 10, 0.0, 7);
  frame.center.z() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(carver.insert({frame}), std::invalid_argument);
  CarvingConfig config;
  config.behind_distance_m = 0.0;
  EXPECT_THROW(SpaceCarver{config}, std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
