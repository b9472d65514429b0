// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// MapWorker used from many threads at once: for ThreadSanitizer (FACET_MAPPING_SANITIZE=thread),
// and without it for deadlocks and lost frames.
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "support/wall_frame.h"
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "facet_mapping/ros/map_worker.h"

namespace facet_mapping {
namespace {

PointFrame wall_seen_from(double x) {
  return test::wall_seen_from(x, 4, 0.5F);
}

MapConfig small_map() {
  MapConfig config;
  config.max_range_m = 10.0;
  config.frozen_beyond_m = 10.0;
  config.carving.steiner_reach_m = 10.0;
  return config;
}

PoseCorrections lift_all(std::size_t keyframes) {
  PoseCorrections corrections;
  for (std::size_t k = 0; k < keyframes; ++k) {
    PoseCorrection pose;
    pose.id = static_cast<KeyframeId>(k);
    pose.world_from_frame.translation() = Eigen::Vector3d(static_cast<double>(k), 0.0, 0.1);
    corrections.poses.push_back(pose);
  }
  return corrections;
}

class MapWorkerThreadsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ClassInfo wall;
    wall.id = 1;
    wall.name = "wall";
    worker_ = std::make_unique<MapWorker>(
        LabelSet({wall}),
        small_map(),
        CloudConfig(),
        kQueueSize,
        0.0,
        MapWorker::Callbacks{[this](const FrameReport&) { ++frames_; },
                             [](const CloudReport&) {},
                             [this](const MapUpdate& update) { note(update); },
                             [this](const std::string&) { ++errors_; },
                             [this](const CorrectionReport&) { ++corrections_; }});
  }

  void note(const MapUpdate& update) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++updates_;
    last_ = update;
    changed_.notify_all();
  }

  /// True once an update holds so many keyframes.
  bool wait_for_keyframes(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(
        lock, std::chrono::seconds(120), [&] { return last_.keyframes >= count; });
  }

  void push_until_taken(double x) {
    while (!worker_->push(wall_seen_from(x), "a", false)) {
      std::this_thread::yield();
    }
  }

  static constexpr std::size_t kQueueSize = 4;
  // ThreadSanitizer does not see how TBB, which is not built with it, hands work to its threads;
  // one thread says nothing less about the worker's own.
  tbb::global_control one_thread_{tbb::global_control::max_allowed_parallelism, 1};
  std::mutex mutex_;
  std::condition_variable changed_;
  MapUpdate last_;
  std::size_t updates_ = 0;
  std::atomic<std::size_t> frames_{0};
  std::atomic<std::size_t> errors_{0};
  std::atomic<std::size_t> corrections_{0};
  std::unique_ptr<MapWorker> worker_;
};

TEST_F(MapWorkerThreadsTest, TwoSourcesAndCorrectionsLoseNothing) {
  constexpr int kFrames = 20;
  std::thread even([&] {
    for (int k = 0; k < kFrames; k += 2) {
      push_until_taken(k);
    }
  });
  std::thread odd([&] {
    for (int k = 1; k < kFrames; k += 2) {
      push_until_taken(k);
    }
  });
  std::atomic<bool> done{false};
  std::size_t taken = 0;
  std::thread corrector([&] {
    while (!done) {
      taken += worker_->correct(lift_all(5)) ? 1 : 0;
      std::this_thread::yield();
    }
  });
  std::thread watcher([&] {
    while (!done) {
      EXPECT_LE(worker_->size(), 2 * kQueueSize + 2);
      EXPECT_LT(worker_->bytes(), 1U << 20U);
      std::this_thread::yield();
    }
  });
  even.join();
  odd.join();
  EXPECT_TRUE(wait_for_keyframes(2));
  while (frames_ < kFrames) {
    std::this_thread::yield();
  }
  done = true;
  corrector.join();
  watcher.join();
  while (worker_->size() > 0) {
    std::this_thread::yield();
  }
  worker_->stop();
  EXPECT_EQ(frames_, static_cast<std::size_t>(kFrames));
  EXPECT_EQ(corrections_, taken);
  EXPECT_EQ(errors_, 0U);
}

TEST_F(MapWorkerThreadsTest, ResetsFromAnotherThread) {
  std::atomic<bool> done{false};
  std::thread driver([&] {
    for (int k = 0; !done; ++k) {
      worker_->push(wall_seen_from(k % 40), "a", false);
      std::this_thread::yield();
    }
  });
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(wait_for_keyframes(1));
    worker_->reset([this] {
      const std::lock_guard<std::mutex> lock(mutex_);
      last_ = {};
    });
  }
  done = true;
  driver.join();
  worker_->stop();  // an update may still be under way
  EXPECT_GE(updates_, 10U);
  EXPECT_EQ(errors_, 0U);
}

TEST_F(MapWorkerThreadsTest, StopsWhileOthersPush) {
  std::vector<std::thread> drivers;
  std::atomic<bool> done{false};
  for (int t = 0; t < 3; ++t) {
    drivers.emplace_back([&, t] {
      for (int k = 0; !done; ++k) {
        worker_->push(wall_seen_from(k + 0.3 * t), std::to_string(t), k % 2 == 0);
        worker_->correct(lift_all(3));
      }
    });
  }
  EXPECT_TRUE(wait_for_keyframes(3));
  worker_->stop();
  EXPECT_FALSE(worker_->push(wall_seen_from(0.0), "a", false));
  done = true;
  for (std::thread& driver : drivers) {
    driver.join();
  }
  const std::size_t frames = frames_;
  std::this_thread::yield();
  EXPECT_EQ(frames_, frames);
}

}  // namespace
}  // namespace facet_mapping
