// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A corridor driven once for all tests of a program, with stereo_points, mapper and refiner
// running.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "node_harness.h"
#include <gtest/gtest.h>

#include "facet_mapping/geometry/mesh.h"

namespace facet_mapping::test {

constexpr int kFrames = 5;
constexpr double kStepM = 0.8;

template <typename Message>
class LastMessage {
 public:
  explicit LastMessage(const std::string& topic) {
    subscriber_ = ros::NodeHandle().subscribe<Message>(
        topic, 100, [this](const boost::shared_ptr<const Message>& message) { last_ = message; });
  }
  bool wait() const {
    return wait_until([this] { return last_ != nullptr; });
  }
  const boost::shared_ptr<const Message>& get() const { return last_; }

 private:
  ros::Subscriber subscriber_;
  boost::shared_ptr<const Message> last_;
};

template <typename Service>
typename Service::Response call(const std::string& name,
                                const typename Service::Request& request = {}) {
  Service service;
  service.request = request;
  EXPECT_TRUE(ros::service::waitForService(name, 10000));
  EXPECT_TRUE(ros::service::call(name, service)) << name;
  return service.response;
}

/// Corners of the facets of a class, in whole millimetres.
inline std::set<std::array<long, 3>> corners_of(const TriangleMesh& mesh, Label label) {
  std::set<std::array<long, 3>> corners;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (int k = 0; mesh.labels[f] == label && k < 3; ++k) {
      const Eigen::Vector3d mm = 1e3 * mesh.vertices[mesh.triangles[f][k]];
      corners.insert({std::lround(mm.x()), std::lround(mm.y()), std::lround(mm.z())});
    }
  }
  return corners;
}

/// Share of the corners that are still there.
inline double share_kept(const std::set<std::array<long, 3>>& before,
                         const std::set<std::array<long, 3>>& after) {
  std::size_t kept = 0;
  for (const std::array<long, 3>& corner : before) {
    kept += after.count(corner);
  }
  return static_cast<double>(kept) / static_cast<double>(before.size());
}

class MappedCorridor : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    map_mesh_ = std::make_unique<MeshEar>("mapper/mesh");
    diagnostics_ = std::make_unique<DiagnosticsEar>();
    car_ = std::make_unique<CorridorCar>();
    arrived_ = drive();
  }
  void SetUp() override { ASSERT_TRUE(arrived_) << "not every frame became a keyframe"; }

  static bool drive() {
    if (!wait_until([] { return car_->is_connected(); })) {
      return false;
    }
    // The nodes connect to each other in their own time, and until then stereo_points is lazy.
    const auto has_begun = [] {
      car_->drive_to(0.0, ros::Time::now());
      wait_until([] { return false; }, 0.3);
      return has_keyframes(1);
    };
    if (!wait_until(has_begun, 60.0)) {
      return false;
    }
    for (int k = 1; k < kFrames; ++k) {
      car_->drive_to(k * kStepM, ros::Time::now());
      wait_until([] { return false; }, 0.1);
    }
    return wait_for_map(kFrames);
  }

  static bool has_keyframes(std::uint64_t count) {
    return diagnostics_->value("mapper", "keyframes") == count &&
           diagnostics_->value("refiner", "keyframes") == count;
  }

  static bool wait_for_map(std::uint64_t keyframes) {
    const auto is_mapped = [keyframes] {
      return has_keyframes(keyframes) &&
             diagnostics_->value("mapper", "frames waiting for the map") == 0 &&
             map_mesh_->has_facets();
    };
    const bool mapped = wait_until(is_mapped, 60.0);
    wait_until([] { return false; }, 0.5);  // the last delta
    return mapped;
  }

  static void TearDownTestSuite() {
    car_.reset();
    diagnostics_.reset();
    map_mesh_.reset();
  }

  inline static std::unique_ptr<MeshEar> map_mesh_;
  inline static std::unique_ptr<DiagnosticsEar> diagnostics_;
  inline static std::unique_ptr<CorridorCar> car_;
  inline static bool arrived_ = false;
};

}  // namespace facet_mapping::test
