// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Refining a part: that improves, the rest stays as it is.
#include <cmath>
#include <stdexcept>

#include "refine_scenes.h"
#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

using test::Scene;

/// The right half of the plane.
MeshPart right_half() {
  MeshPart part;
  part.box = Eigen::AlignedBox3d(Eigen::Vector3d(0.0, -9.0, -9.0), Eigen::Vector3d(9.0, 9.0, 9.0));
  return part;
}

double rms_z(const TriangleMesh& mesh, double from_x, double to_x) {
  double sum = 0.0;
  int count = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    if (v.x() > from_x && v.x() < to_x && std::abs(v.y()) < 0.6) {
      sum += v.z() * v.z();
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

/// Of the start's vertices that touch a facet outside the part, how many have moved.
std::size_t moved_outside(const TriangleMesh& start,
                          const MeshPart& part,
                          const TriangleMesh& end) {
  const std::vector<std::uint8_t> inside = vertices_inside(start, facets_of_part(start, part));
  std::size_t moved = 0;
  for (std::size_t k = 0; k < start.vertices.size(); ++k) {
    moved += inside[k] == 0 && start.vertices[k] != end.vertices[k] ? 1 : 0;
  }
  return moved;
}

TEST(RefinePart, OnlyWhatLiesInTheBoxMoves) {
  const Scene scene = test::wavy_plane();
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 1e9;
  config.part = right_half();
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  EXPECT_EQ(moved_outside(scene.mesh, config.part, result.mesh), 0U);
  EXPECT_EQ(rms_z(result.mesh, -0.8, -0.1), rms_z(scene.mesh, -0.8, -0.1));
  EXPECT_LT(rms_z(result.mesh, 0.2, 0.8), 0.25 * rms_z(scene.mesh, 0.2, 0.8));
}

TEST(RefinePart, ABoxMayHaveAxesOfItsOwn) {
  const Scene scene = test::wavy_plane();
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 1e9;
  config.part = right_half();
  config.part.box_from_mesh = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ());
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  EXPECT_EQ(rms_z(result.mesh, 0.1, 0.8), rms_z(scene.mesh, 0.1, 0.8));
  EXPECT_LT(rms_z(result.mesh, -0.8, -0.2), 0.25 * rms_z(scene.mesh, -0.8, -0.2));
}

TEST(RefinePart, OnlyFacetsOfTheClassesMoveOrChangeTheirClass) {
  Scene scene = test::wavy_plane();
  for (const Triangle& t : scene.mesh.triangles) {
    scene.mesh.labels.push_back(scene.mesh.vertices[t[0]].x() > 0.0 ? 2 : 1);
  }
  for (LabeledView& view : scene.views) {  // an image that says 3 everywhere
    view.labels = cv::Mat(view.gray.size(), CV_16UC1, cv::Scalar(3));
  }
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 1e9;
  config.relabel = true;
  config.part.classes = {2};
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  EXPECT_EQ(moved_outside(scene.mesh, config.part, result.mesh), 0U);
  EXPECT_GT(result.relabelled, 100U);
  for (std::size_t f = 0; f < scene.mesh.labels.size(); ++f) {
    const Label label = result.mesh.labels[f];
    EXPECT_TRUE(scene.mesh.labels[f] == 1 ? label == 1 : label != 1) << "facet " << f;
  }
}

TEST(RefinePart, SubdivisionLeavesTheRestOfTheSurfaceWhereItIs) {
  Scene scene = test::wavy_plane();
  RefinementConfig config = test::photometric_config();
  config.subdivide_px = 8.0;
  config.part = right_half();
  const RefinementResult result = refine(scene.mesh, scene.views, LabelSet(), config);
  EXPECT_GT(result.facets_after, scene.mesh.triangles.size());
  EXPECT_EQ(moved_outside(scene.mesh, config.part, result.mesh), 0U);
  std::size_t left = 0;
  for (const Eigen::Vector3d& v : result.mesh.vertices) {
    left += v.x() < -0.2 ? 1 : 0;
  }
  for (const Eigen::Vector3d& v : scene.mesh.vertices) {
    left -= v.x() < -0.2 ? 1 : 0;
  }
  EXPECT_EQ(left, 0U);
}

TEST(RefinePart, APartThatIsNotThereOrNotSeenIsRefused) {
  const Scene scene = test::wavy_plane();
  RefinementConfig config = test::photometric_config();
  config.part.box =
      Eigen::AlignedBox3d(Eigen::Vector3d(50.0, 50.0, 50.0), Eigen::Vector3d(51.0, 51.0, 51.0));
  EXPECT_THROW(refine(scene.mesh, scene.views, LabelSet(), config), std::invalid_argument);
  config.part = MeshPart();
  config.part.classes = {1};  // the mesh has no classes
  EXPECT_THROW(refine(scene.mesh, scene.views, LabelSet(), config), std::invalid_argument);
  Scene blind = test::wavy_plane();
  for (LabeledView& view : blind.views) {
    view.view.world_from_cam.translation() += Eigen::Vector3d(100.0, 0.0, 0.0);
  }
  config.part = right_half();
  EXPECT_THROW(refine(blind.mesh, blind.views, LabelSet(), config), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
