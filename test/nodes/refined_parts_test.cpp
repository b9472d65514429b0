// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What was refined stays while the map grows; jobs that end early keep the best so far.
#include <algorithm>
#include <future>

#include "corridor.h"
#include "mapped_corridor.h"
#include <gtest/gtest.h>

#include "facet_mapping/CancelRefine.h"
#include "facet_mapping/GetMesh.h"
#include "facet_mapping/Refine.h"
#include "facet_mapping/RefineProgress.h"
#include "facet_mapping/geometry/manifold.h"
#include "facet_mapping/ros/mesh_conversions.h"

namespace facet_mapping::test {
namespace {

using RefinedPartsTest = MappedCorridor;

Refine::Request long_request() {
  Refine::Request request;
  request.iterations = 1000;
  request.levels = 1;
  request.return_mesh = 1;
  return request;
}

std::future<Refine::Response> refine_aside(const Refine::Request& request) {
  return std::async(std::launch::async, [request] {
    Refine service;
    service.request = request;
    ros::service::call("refiner/refine", service);
    return service.response;
  });
}

void expect_best_so_far(const Refine::Response& response) {
  EXPECT_LE(response.after.photometric, response.before.photometric);
  EXPECT_TRUE(check_manifold(mesh_from_message(response.mesh)).is_closed_manifold());
  const TriangleMesh kept = mesh_from_message(call<GetMesh>("refiner/get_mesh").mesh);
  EXPECT_EQ(kept.triangles.size(), response.facets_after);
}

TEST_F(RefinedPartsTest, ACancelledJobKeepsTheBestSoFar) {
  const LastMessage<RefineProgress> progress("refiner/progress");
  auto answer = refine_aside(long_request());
  ASSERT_TRUE(progress.wait());
  EXPECT_EQ(call<Refine>("refiner/refine").status.code, Status::BUSY);
  EXPECT_EQ(call<CancelRefine>("refiner/cancel_refine").status.code, Status::OK);
  const Refine::Response response = answer.get();
  EXPECT_EQ(response.status.code, Status::CANCELLED) << response.status.message;
  expect_best_so_far(response);
}

TEST_F(RefinedPartsTest, AJobEndsWhenItsTimeIsUsedUp) {
  Refine::Request request = long_request();
  request.time_budget = 0.5;
  const auto response = call<Refine>("refiner/refine", request);
  EXPECT_EQ(response.status.code, Status::OK) << response.status.message;
  EXPECT_NE(response.status.message.find("time budget"), std::string::npos);
  EXPECT_GE(response.seconds, request.time_budget);
  expect_best_so_far(response);
}

TEST_F(RefinedPartsTest, ARefinedPartOutlivesTheNextMapUpdate) {
  const MeshEar refined("refiner/mesh");
  Refine::Request request;
  request.levels = 1;
  request.iterations = 3;
  request.return_mesh = 1;
  const auto response = call<Refine>("refiner/refine", request);
  ASSERT_EQ(response.status.code, Status::OK) << response.status.message;
  const TriangleMesh result = mesh_from_message(response.mesh);
  const auto map_before = corners_of(map_mesh_->receiver().mesh(), kBuilding);

  const std::size_t messages = map_mesh_->messages();
  car_->drive_to(kFrames * kStepM, ros::Time::now());
  ASSERT_TRUE(wait_for_map(kFrames + 1));
  ASSERT_GT(map_mesh_->messages(), messages);
  const auto is_up_to_date = [&] {
    return refined.receiver().stamp() == map_mesh_->receiver().stamp();
  };
  ASSERT_TRUE(wait_until(is_up_to_date));
  const TriangleMesh map = map_mesh_->receiver().mesh();
  const TriangleMesh merged = refined.receiver().mesh();
  EXPECT_TRUE(check_manifold(merged).is_closed_manifold()) << check_manifold(merged).to_string();
  EXPECT_FALSE(refined.missed_something());

  // As much of the refined walls is kept as the mapper kept of its own ...
  const double map_kept = share_kept(map_before, corners_of(map, kBuilding));
  const auto walls = corners_of(result, kBuilding);
  EXPECT_GT(share_kept(walls, corners_of(merged, kBuilding)), map_kept - 0.2);
  EXPECT_GT(map_kept, 0.5);
  // ... and those are not the mapper's.
  EXPECT_LT(share_kept(walls, corners_of(map, kBuilding)), 0.6);
}

TEST_F(RefinedPartsTest, RefiningASecondPartLeavesTheFirst) {
  Refine::Request request;
  request.levels = 1;
  request.iterations = 3;
  request.return_mesh = 1;
  request.classes = {kBuilding};
  const auto walls = call<Refine>("refiner/refine", request);
  ASSERT_EQ(walls.status.code, Status::OK) << walls.status.message;
  request.classes = {kRoad};
  const auto road = call<Refine>("refiner/refine", request);
  ASSERT_EQ(road.status.code, Status::OK) << road.status.message;
  const TriangleMesh kept = mesh_from_message(call<GetMesh>("refiner/get_mesh").mesh);
  const TriangleMesh refined_walls = mesh_from_message(walls.mesh);
  EXPECT_GT(share_kept(corners_of(refined_walls, kBuilding), corners_of(kept, kBuilding)), 0.7);
  const TriangleMesh refined_road = mesh_from_message(road.mesh);
  EXPECT_GT(share_kept(corners_of(refined_road, kRoad), corners_of(kept, kRoad)), 0.7);
  EXPECT_TRUE(check_manifold(kept).is_closed_manifold()) << check_manifold(kept).to_string();
}

}  // namespace
}  // namespace facet_mapping::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "refined_parts_test");
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
