// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>
#include <stdexcept>

#include "support/meshes.h"
#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"
#include "facet_mapping/ros/mesh_conversions.h"
#include "facet_mapping/ros/mesh_filter.h"
#include "facet_mapping/ros/mesh_receiver.h"
#include "facet_mapping/ros/mesh_stats.h"

namespace facet_mapping {
namespace {

using visualization_msgs::Marker;

constexpr double kChunkSizeM = 2.0;

LabelSet two_classes() {
  return LabelSet({{0, "road", {128, 64, 128}}, {1, "wall", {70, 70, 70}}});
}

/// A sphere of 5 m radius, class 1 where x > 0, class 0 elsewhere.
TriangleMesh labelled_sphere() {
  TriangleMesh mesh = test::make_uv_sphere(5.0, 12, 24);
  mesh.confidence.assign(mesh.triangles.size(), 1.0F);
  mesh.views.assign(mesh.triangles.size(), 3);
  for (const Triangle& t : mesh.triangles) {
    const double x = mesh.vertices[t[0]].x() + mesh.vertices[t[1]].x() + mesh.vertices[t[2]].x();
    mesh.labels.push_back(x > 0.0 ? 1 : 0);
  }
  return mesh;
}

LabeledMesh full_message(const ChunkedMesh& chunks, std::uint32_t sequence) {
  LabeledMesh message;
  message.full = 1;
  message.map_id = "a";
  message.sequence = sequence;
  for (const auto& [key, chunk] : chunks.chunks()) {
    message.chunks.push_back(chunk_to_message(chunk));
  }
  return message;
}

LabeledMesh delta_message(const ChunkDelta& delta, std::uint32_t sequence) {
  LabeledMesh message;
  message.map_id = "a";
  message.sequence = sequence;
  for (const MeshChunk& chunk : delta.changed) {
    message.chunks.push_back(chunk_to_message(chunk));
  }
  for (const ChunkKey& key : delta.removed) {
    message.removed_keys.insert(message.removed_keys.end(), key.begin(), key.end());
  }
  return message;
}

TEST(ChunkMessage, NothingIsLostOnTheWay) {
  ChunkedMesh chunks(kChunkSizeM);
  chunks.update(labelled_sphere());
  for (const auto& [key, chunk] : chunks.chunks()) {
    const MeshChunk back = chunk_from_message(chunk_to_message(chunk));
    EXPECT_EQ(back.key, chunk.key);
    EXPECT_EQ(back.revision, chunk.revision);
    EXPECT_EQ(back.origin, chunk.origin);
    EXPECT_EQ(back.vertices, chunk.vertices);
    EXPECT_EQ(back.vertex_ids, chunk.vertex_ids);
    EXPECT_EQ(back.triangles, chunk.triangles);
    EXPECT_EQ(back.labels, chunk.labels);
    EXPECT_EQ(back.confidence, chunk.confidence);
    EXPECT_EQ(back.views, chunk.views);
  }
}

TEST(ChunkMessage, ContradictionsAreRefused) {
  ChunkedMesh chunks(kChunkSizeM);
  chunks.update(labelled_sphere());
  const LabeledMeshChunk good = chunk_to_message(chunks.chunks().begin()->second);
  LabeledMeshChunk bad = good;
  bad.labels.push_back(0);
  EXPECT_THROW(chunk_from_message(bad), std::invalid_argument);
  bad = good;
  bad.triangles[0] = static_cast<std::uint32_t>(bad.vertices.size());
  EXPECT_THROW(chunk_from_message(bad), std::invalid_argument);
  bad = good;
  bad.triangles.pop_back();
  EXPECT_THROW(chunk_from_message(bad), std::invalid_argument);
  bad = good;
  bad.vertex_ids.push_back(0);
  EXPECT_THROW(chunk_from_message(bad), std::invalid_argument);
}

TEST(MeshMessage, FullMessageWeldsToAClosedManifold) {
  const TriangleMesh sphere = labelled_sphere();
  ChunkedMesh chunks(kChunkSizeM);
  chunks.update(sphere);
  ASSERT_GT(chunks.chunks().size(), 10U);
  const TriangleMesh mesh = mesh_from_message(full_message(chunks, 1));
  EXPECT_EQ(mesh.triangles.size(), sphere.triangles.size());
  EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size());
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold());
}

TEST(MeshReceiver, DeltasGiveTheSameMeshAsAFullMessage) {
  ChunkedMesh chunks(kChunkSizeM);
  MeshReceiver receiver;
  TriangleMesh mesh = labelled_sphere();
  chunks.update(mesh);
  EXPECT_EQ(receiver.apply(full_message(chunks, 1)), MeshReceiver::Result::kApplied);
  for (Eigen::Vector3d& vertex : mesh.vertices) {
    vertex.z() += vertex.x() > 2.0 ? 3.0 : 0.0;  // some chunks change, appear and vanish
  }
  const ChunkDelta delta = chunks.update(mesh);
  EXPECT_LT(delta.changed.size(), chunks.chunks().size());
  EXPECT_GT(delta.removed.size(), 0U);
  EXPECT_EQ(receiver.apply(delta_message(delta, 2)), MeshReceiver::Result::kApplied);
  const TriangleMesh received = receiver.mesh();
  const TriangleMesh expected = mesh_from_message(full_message(chunks, 2));
  EXPECT_EQ(received.vertices, expected.vertices);
  EXPECT_EQ(received.triangles, expected.triangles);
  EXPECT_EQ(received.labels, expected.labels);
  EXPECT_TRUE(check_manifold(received).is_closed_manifold());
}

TEST(MeshReceiver, GapsAndOldMessagesAreNoticed) {
  using Result = MeshReceiver::Result;
  ChunkedMesh chunks(kChunkSizeM);
  chunks.update(labelled_sphere());
  MeshReceiver receiver;
  EXPECT_EQ(receiver.apply(delta_message({}, 1)), Result::kGap);
  EXPECT_FALSE(receiver.has_mesh());
  EXPECT_EQ(receiver.apply(full_message(chunks, 5)), Result::kApplied);
  EXPECT_EQ(receiver.apply(delta_message({}, 5)), Result::kOld);
  EXPECT_EQ(receiver.apply(delta_message({}, 7)), Result::kGap);
  EXPECT_EQ(receiver.sequence(), 5U);
  EXPECT_EQ(receiver.apply(delta_message({}, 6)), Result::kApplied);
  LabeledMesh other_map = delta_message({}, 7);
  other_map.map_id = "b";
  EXPECT_EQ(receiver.apply(other_map), Result::kGap);
  other_map.full = 1;
  EXPECT_EQ(receiver.apply(other_map), Result::kApplied);
  EXPECT_TRUE(receiver.mesh().empty());
}

TEST(MeshReceiver, BadMessageLeavesTheStateAlone) {
  ChunkedMesh chunks(kChunkSizeM);
  chunks.update(labelled_sphere());
  MeshReceiver receiver;
  receiver.apply(full_message(chunks, 1));
  LabeledMesh bad = full_message(chunks, 2);
  bad.chunks.back().labels.push_back(0);
  EXPECT_THROW(receiver.apply(bad), std::invalid_argument);
  EXPECT_EQ(receiver.sequence(), 1U);
  EXPECT_FALSE(receiver.mesh().empty());
}

std::size_t count_triangles(const visualization_msgs::MarkerArray& array) {
  std::size_t points = 0;
  for (const Marker& marker : array.markers) {
    EXPECT_FALSE(marker.action == Marker::ADD && marker.points.empty());
    points += marker.action == Marker::ADD ? marker.points.size() : 0;
  }
  return points / 3;
}

TEST(Markers, OnePerClassInItsColourAndNamespace) {
  const TriangleMesh mesh = labelled_sphere();
  std::set<Label> shown;
  const auto array = markers_from_mesh(mesh, two_classes(), std_msgs::Header(), 100000, &shown);
  ASSERT_EQ(array.markers.size(), 2U);
  EXPECT_EQ(count_triangles(array), mesh.triangles.size());
  EXPECT_EQ(array.markers[0].ns, "road");
  EXPECT_EQ(array.markers[1].ns, "wall");
  EXPECT_FLOAT_EQ(array.markers[0].color.g, 64.0F / 255.0F);
  EXPECT_EQ(shown, (std::set<Label>{0, 1}));
}

TEST(Markers, VanishedClassesAreDeleted) {
  TriangleMesh mesh = labelled_sphere();
  std::set<Label> shown;
  markers_from_mesh(mesh, two_classes(), std_msgs::Header(), 100000, &shown);
  std::fill(mesh.labels.begin(), mesh.labels.end(), 0);
  const auto array = markers_from_mesh(mesh, two_classes(), std_msgs::Header(), 100000, &shown);
  ASSERT_EQ(array.markers.size(), 2U);
  EXPECT_EQ(array.markers[1].ns, "wall");
  EXPECT_EQ(array.markers[1].action, Marker::DELETE);
  EXPECT_EQ(array.markers[1].id, 1);
  const auto gone =
      markers_from_mesh(TriangleMesh(), two_classes(), std_msgs::Header(), 100000, &shown);
  ASSERT_EQ(gone.markers.size(), 1U);
  EXPECT_EQ(gone.markers[0].action, Marker::DELETE);
  EXPECT_TRUE(markers_from_mesh(TriangleMesh(), two_classes(), std_msgs::Header(), 100000, &shown)
                  .markers.empty());
}

TEST(Markers, BigMeshIsDecimated) {
  const TriangleMesh mesh = labelled_sphere();
  std::set<Label> shown;
  const auto array = markers_from_mesh(mesh, two_classes(), std_msgs::Header(), 100, &shown);
  EXPECT_LE(count_triangles(array), 100U);
  EXPECT_GE(count_triangles(array), 20U);
}

TEST(Markers, DecimationEndsOnDegenerateMeshes) {
  TriangleMesh mesh;
  mesh.vertices.assign(30, Eigen::Vector3d(1.0, 2.0, 3.0));
  for (std::uint32_t f = 0; f < 10; ++f) {
    mesh.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  EXPECT_TRUE(decimate_for_display(mesh, 5).empty());
}

BoxRegion box(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  BoxRegion region;
  region.min.x = min.x();
  region.min.y = min.y();
  region.min.z = min.z();
  region.max.x = max.x();
  region.max.y = max.y();
  region.max.z = max.z();
  return region;
}

TEST(Filter, RegionAndClassesSelectFacets) {
  const TriangleMesh mesh = labelled_sphere();
  const auto identity = Eigen::Isometry3d::Identity();
  EXPECT_EQ(filter_mesh(mesh, BoxRegion(), identity, {}).triangles.size(), mesh.triangles.size());
  const TriangleMesh walls = filter_mesh(mesh, BoxRegion(), identity, {1});
  EXPECT_EQ(walls.triangles.size(), mesh.triangles.size() / 2);
  const BoxRegion right = box({0, -10, -10}, {10, 10, 10});
  EXPECT_EQ(filter_mesh(mesh, right, identity, {}).triangles.size(), walls.triangles.size());
  EXPECT_TRUE(filter_mesh(mesh, right, identity, {0}).empty());
  // The same box seen from a frame turned by half a turn about z selects the other half.
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(filter_mesh(mesh, right, turned, {1}).empty());
}

TEST(Filter, ImpossibleRegionsAreRefused) {
  EXPECT_THROW(validate(box({1, 0, 0}, {0, 1, 1})), std::invalid_argument);
  EXPECT_THROW(validate(box({0, 0, 0}, {NAN, 1, 1})), std::invalid_argument);
  EXPECT_NO_THROW(validate(BoxRegion()));
}

TEST(Stats, AreasAddUp) {
  const TriangleMesh mesh = labelled_sphere();
  MeshStats stats;
  fill_mesh_stats(totals_of(mesh), &stats);
  EXPECT_EQ(stats.facets, mesh.triangles.size());
  EXPECT_EQ(stats.class_ids, (std::vector<std::uint16_t>{0, 1}));
  EXPECT_NEAR(stats.area, 4.0 * M_PI * 25.0, 0.05 * stats.area);
  EXPECT_NEAR(stats.class_areas[0] + stats.class_areas[1], stats.area, 1e-9);
  EXPECT_DOUBLE_EQ(stats.mean_confidence, 1.0);
}

TEST(Palette, HoldsTheClassList) {
  const ClassPalette palette = palette_message(two_classes(), "file.yaml", 1);
  ASSERT_EQ(palette.classes.size(), 2U);
  EXPECT_EQ(palette.classes[1].name, "wall");
  EXPECT_FLOAT_EQ(palette.classes[0].color.r, 128.0F / 255.0F);
}

}  // namespace
}  // namespace facet_mapping
