// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/map_worker.h"

#include <future>
#include <vector>

#include "support/wall_frame.h"
#include <gtest/gtest.h>

#include "facet_mapping/geometry/manifold.h"

namespace facet_mapping {
namespace {

PointFrame wall_seen_from(double x) {
  return test::wall_seen_from(x, 8, 0.3F);
}

class MapWorkerTest : public testing::Test {
 protected:
  std::unique_ptr<MapWorker> make_worker(std::size_t queue_size, double period_s) {
    return std::make_unique<MapWorker>(
        LabelSet({{1, "wall", {70, 70, 70}}}),
        MapConfig(),
        CloudConfig(),
        queue_size,
        period_s,
        MapWorker::Callbacks{[this](const FrameReport& report) { reports_.push_back(report); },
                             [this](const CloudReport& report) { scans_.push_back(report); },
                             [this](MapUpdate update) { push(std::move(update)); },
                             [this](const std::string& error) { errors_.push_back(error); }});
  }

  void push(MapUpdate update) {
    const std::lock_guard<std::mutex> lock(mutex_);
    updates_.push_back(std::move(update));
    changed_.notify_all();
  }

  MapUpdate wait_for_update(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(60), [&] { return updates_.size() >= count; });
    return updates_.size() >= count ? updates_[count - 1] : MapUpdate();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<MapUpdate> updates_;
  std::vector<FrameReport> reports_;
  std::vector<CloudReport> scans_;
  std::vector<std::string> errors_;
};

TEST_F(MapWorkerTest, FramesBecomeAClosedLabelledSurface) {
  const auto worker = make_worker(10, 0.0);
  EXPECT_TRUE(worker->push(wall_seen_from(0.0), "a", false));
  EXPECT_TRUE(worker->push(wall_seen_from(1.0), "a", false));
  MapUpdate update = wait_for_update(1);
  if (update.keyframes < 2) {
    update = wait_for_update(2);
  }
  worker->stop();
  ASSERT_EQ(update.keyframes, 2U);
  EXPECT_EQ(update.stamp, 101.0);
  ASSERT_FALSE(update.surface.mesh.empty());
  EXPECT_TRUE(check_manifold(update.surface.mesh).is_closed_manifold());
  EXPECT_EQ(reports_.size(), 2U);
}

TEST_F(MapWorkerTest, ScansAreCleanedFirst) {
  const auto worker = make_worker(10, 0.0);
  PointFrame scan = wall_seen_from(0.0);
  scan.points.push_back({Eigen::Vector3f(0.0F, 0.0F, 20.0F), kUnlabelled, 0.0F});  // a raindrop
  worker->push(scan, "lidar", true);
  wait_for_update(1);
  worker->stop();
  ASSERT_EQ(scans_.size(), 1U);
  EXPECT_EQ(scans_[0].isolated, 1U);
  EXPECT_EQ(reports_[0].used, scan.points.size() - 1);
}

TEST_F(MapWorkerTest, FullQueueRefuses) {
  const auto worker = make_worker(2, 1000.0);
  worker->push(wall_seen_from(0.0), "a", false);
  wait_for_update(1);
  while (worker->size() > 0) {
    std::this_thread::yield();
  }
  // From now on the worker pauses.
  EXPECT_TRUE(worker->push(wall_seen_from(1.0), "a", false));
  EXPECT_TRUE(worker->push(wall_seen_from(2.0), "a", false));
  EXPECT_FALSE(worker->push(wall_seen_from(3.0), "a", false));
  EXPECT_EQ(worker->size(), 2U);
}

TEST_F(MapWorkerTest, ResetForgetsMapAndQueue) {
  const auto worker = make_worker(10, 0.0);
  worker->push(wall_seen_from(0.0), "a", false);
  wait_for_update(1);
  bool told = false;
  worker->reset([&told] { told = true; });
  EXPECT_TRUE(told);
  worker->push(wall_seen_from(5.0), "a", false);
  EXPECT_EQ(wait_for_update(2).keyframes, 1U);
}

TEST_F(MapWorkerTest, BadPoseIsReportedAndTheWorkerLives) {
  const auto worker = make_worker(10, 0.0);
  PointFrame bad = wall_seen_from(0.0);
  bad.world_from_sensor.translation().x() = NAN;
  worker->push(bad, "a", false);
  worker->push(wall_seen_from(1.0), "a", false);
  EXPECT_EQ(wait_for_update(1).keyframes, 1U);
  worker->stop();
  EXPECT_EQ(errors_.size(), 1U);
}

TEST_F(MapWorkerTest, StopInThePauseReturnsAtOnce) {
  const auto worker = make_worker(10, 1000.0);
  worker->push(wall_seen_from(0.0), "a", false);
  wait_for_update(1);
  worker->push(wall_seen_from(1.0), "a", false);
  worker->stop();
  EXPECT_FALSE(worker->push(wall_seen_from(2.0), "a", false));
}

}  // namespace
}  // namespace facet_mapping
