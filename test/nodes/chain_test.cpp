// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Images in, refined labelled mesh file out: stereo_points, mapper and refiner together.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <set>

#include "corridor.h"
#include "mapped_corridor.h"
#include <gtest/gtest.h>

#include "facet_mapping/CancelRefine.h"
#include "facet_mapping/ClassPalette.h"
#include "facet_mapping/GetMesh.h"
#include "facet_mapping/MeshStats.h"
#include "facet_mapping/Refine.h"
#include "facet_mapping/RefineProgress.h"
#include "facet_mapping/Relabel.h"
#include "facet_mapping/SaveMesh.h"
#include "facet_mapping/geometry/manifold.h"
#include "facet_mapping/io/ply.h"
#include "facet_mapping/ros/mesh_conversions.h"

namespace facet_mapping::test {
namespace {

std::set<Label> classes_of(const TriangleMesh& mesh) {
  return {mesh.labels.begin(), mesh.labels.end()};
}

/// Median distance of the labelled facets' corners from the true surfaces, metres.
double median_error(const TriangleMesh& mesh) {
  std::vector<double> errors;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (mesh.labels[f] != kUnlabelled) {
      errors.push_back(distance_to_corridor(mesh.vertices[mesh.triangles[f][0]]));
    }
  }
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  return errors.empty() ? 1e9 : errors[errors.size() / 2];
}

using ChainTest = MappedCorridor;

TEST_F(ChainTest, MapIsAClosedLabelledManifoldWhereTheCorridorIs) {
  EXPECT_FALSE(map_mesh_->missed_something());
  const TriangleMesh mesh = map_mesh_->receiver().mesh();
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold()) << check_manifold(mesh).to_string();
  EXPECT_EQ(map_mesh_->receiver().frame_id(), "map");
  const std::set<Label> classes = classes_of(mesh);
  EXPECT_EQ(classes.count(kRoad), 1U);
  EXPECT_EQ(classes.count(kBuilding), 1U);
  EXPECT_LT(median_error(mesh), 0.1);
}

TEST_F(ChainTest, GetMeshFiltersByRegionAndClass) {
  const auto whole = call<GetMesh>("mapper/get_mesh");
  ASSERT_EQ(whole.status.code, Status::OK) << whole.status.message;
  EXPECT_EQ(whole.mesh.map_id, map_mesh_->receiver().map_id());
  const TriangleMesh mesh = mesh_from_message(whole.mesh);
  EXPECT_EQ(mesh.triangles.size(), map_mesh_->receiver().mesh().triangles.size());

  GetMesh::Request request;
  request.classes = {kRoad};
  const auto road = call<GetMesh>("mapper/get_mesh", request);
  EXPECT_EQ(classes_of(mesh_from_message(road.mesh)), (std::set<Label>{kRoad}));
  EXPECT_EQ(road.mesh.map_id, "");

  request.classes.clear();
  request.region.frame_id = "camera";
  request.region.min.x = request.region.min.y = -100.0;
  request.region.max.x = request.region.max.y = request.region.max.z = 100.0;
  const auto ahead = mesh_from_message(call<GetMesh>("mapper/get_mesh", request).mesh);
  EXPECT_GT(ahead.triangles.size(), 0U);
  EXPECT_LT(ahead.triangles.size(), mesh.triangles.size());

  request.region.frame_id = "nowhere";
  EXPECT_EQ(call<GetMesh>("mapper/get_mesh", request).status.code, Status::INVALID_ARGUMENT);
}

TEST_F(ChainTest, PaletteIsLatched) {
  const LastMessage<ClassPalette> palette("mapper/palette");
  EXPECT_TRUE(palette.wait());
  ASSERT_EQ(palette.get()->classes.size(), 20U);  // 19 train ids and void
  EXPECT_EQ(palette.get()->classes.at(kBuilding).name, "building");
}

TEST_F(ChainTest, DryRunChangesNothing) {
  Refine::Request request;
  request.dry_run = 1;
  const auto response = call<Refine>("refiner/refine", request);
  EXPECT_EQ(response.status.code, Status::OK) << response.status.message;
  EXPECT_EQ(response.views, kFrames);
  EXPECT_GT(response.peak_memory, 0.0);
  EXPECT_GT(response.seconds, 0.0);
  EXPECT_GE(response.facets_after, response.facets_before);
  EXPECT_GT(response.before.photometric, 0.0);
  EXPECT_EQ(call<GetMesh>("refiner/get_mesh").status.code, Status::NOT_READY);
}

TEST_F(ChainTest, MemoryBudgetAndPartsThatAreNotThereAreRefused) {
  Refine::Request request;
  request.memory_budget = 0.001;
  EXPECT_EQ(call<Refine>("refiner/refine", request).status.code, Status::INVALID_ARGUMENT);
  request = {};
  request.classes = {kRoad};
  request.region.min.x = request.region.max.x = 5000.0;
  EXPECT_EQ(call<Refine>("refiner/refine", request).status.code, Status::INVALID_ARGUMENT);
  request.region.frame_id = "nowhere";
  EXPECT_EQ(call<Refine>("refiner/refine", request).status.code, Status::INVALID_ARGUMENT);
  request = {};
  request.start = Refine::Request::START_REFINED;
  EXPECT_EQ(call<Refine>("refiner/refine", request).status.code, Status::NOT_READY);
  EXPECT_EQ(call<CancelRefine>("refiner/cancel_refine").status.code, Status::NOT_READY);
}

TEST_F(ChainTest, RefiningOneClassLeavesTheOthersAlone) {
  const TriangleMesh before = map_mesh_->receiver().mesh();
  Refine::Request request;
  request.classes = {kBuilding};
  request.iterations = 2;
  request.levels = 1;
  request.return_mesh = 1;
  const auto response = call<Refine>("refiner/refine", request);
  ASSERT_EQ(response.status.code, Status::OK) << response.status.message;
  const TriangleMesh after = mesh_from_message(response.mesh);
  ASSERT_GT(corners_of(before, kRoad).size(), 100U);
  EXPECT_GT(share_kept(corners_of(before, kRoad), corners_of(after, kRoad)), 0.99);
  EXPECT_LT(share_kept(corners_of(before, kBuilding), corners_of(after, kBuilding)), 0.8);
}

TEST_F(ChainTest, RefineLowersTheEnergyAndTheFileReadsBack) {
  const MeshEar refined("refiner/mesh");
  const LastMessage<RefineProgress> progress("refiner/progress");
  const LastMessage<sensor_msgs::Image> label_image("refiner/label_image");
  ASSERT_TRUE(wait_until([&] { return refined.messages() > 0; }));  // the full mesh
  Refine::Request request;
  request.iterations = 3;
  request.levels = 1;
  request.return_mesh = 1;
  const auto response = call<Refine>("refiner/refine", request);
  ASSERT_EQ(response.status.code, Status::OK) << response.status.message;
  EXPECT_LT(response.after.photometric, response.before.photometric);
  EXPECT_EQ(response.facets_before, map_mesh_->receiver().mesh().triangles.size());
  ASSERT_TRUE(progress.wait());
  // A mesh that an earlier refinement left comes first.
  EXPECT_TRUE(wait_until(
      [&] { return refined.receiver().mesh().triangles.size() == response.facets_after; }));
  const TriangleMesh mesh = refined.receiver().mesh();
  EXPECT_EQ(mesh_from_message(response.mesh).triangles.size(), response.facets_after);
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold()) << check_manifold(mesh).to_string();
  EXPECT_LT(median_error(mesh), 0.1);
  ASSERT_TRUE(label_image.wait());
  EXPECT_EQ(label_image.get()->encoding, "mono8");

  const auto folder = std::filesystem::temp_directory_path() / "facet_mapping_chain_test";
  SaveMesh::Request save;
  save.path = (folder / "new" / "street").string();
  const auto saved = call<SaveMesh>("refiner/save_mesh", save);
  ASSERT_EQ(saved.status.code, Status::OK) << saved.status.message;
  EXPECT_EQ(saved.path, save.path + ".ply");
  const MeshFile file = read_ply(saved.path);
  EXPECT_EQ(file.mesh.triangles.size(), response.facets_after);
  EXPECT_EQ(file.frame_id, "map");
  EXPECT_EQ(classes_of(file.mesh), classes_of(mesh));
  std::filesystem::remove_all(folder);
}

TEST_F(ChainTest, RelabelKeepsTheGeometry) {
  const auto response = call<Relabel>("refiner/relabel");
  ASSERT_EQ(response.status.code, Status::OK) << response.status.message;
  EXPECT_GT(response.facets, 0U);
  const TriangleMesh mesh = mesh_from_message(call<GetMesh>("refiner/get_mesh").mesh);
  EXPECT_EQ(classes_of(mesh).count(kRoad), 1U);
  EXPECT_TRUE(check_manifold(mesh).is_closed_manifold());
}

// Last, since it ends the refiner.
TEST_F(ChainTest, ShutdownDoesNotWaitForARunningJob) {
  const LastMessage<RefineProgress> progress("refiner/progress");
  Refine::Request request;
  request.iterations = 1000;
  request.levels = 1;
  auto answered = std::async(std::launch::async, [request] {
    Refine service;
    service.request = request;
    ros::service::call("refiner/refine", service);
  });
  ASSERT_TRUE(progress.wait());
  ASSERT_EQ(std::system("rosnode kill /refiner > /dev/null"), 0);
  EXPECT_EQ(answered.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  EXPECT_TRUE(wait_until([] { return !ros::service::exists("refiner/refine", false); }));
  std::vector<std::string> nodes;
  EXPECT_TRUE(wait_until([&] {
    nodes.clear();  // getNodes() appends
    ros::master::getNodes(nodes);
    return std::find(nodes.begin(), nodes.end(), "/refiner") == nodes.end();
  }));
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "chain_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
