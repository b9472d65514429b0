// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mapper's heavy work in a thread of its own, so that callbacks never starve.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "facet_mapping/mapping/labeled_map.h"
#include "facet_mapping/mapping/pose_corrector.h"
#include "facet_mapping/points/lidar_points.h"

namespace facet_mapping {

/// The map after an update.
struct MapUpdate {
  CarvedSurface surface;
  CarvingStats stats;
  std::size_t keyframes = 0;
  double stamp = 0.0;         ///< of the newest frame in it, seconds
  double seconds = 0.0;       ///< wall time that the update took
  FreezeLine line;            ///< what lies outside is final
  double range_scale = 1.0;   ///< below 1 while the memory budget makes the ranges shrink
  std::size_t map_bytes = 0;  ///< of memory that the map and its bookkeeping hold
  std::shared_ptr<const std::map<KeyframeId, Keyframe>> movable;  ///< with their present poses
};

class MapWorker {
 public:
  struct Callbacks {
    std::function<void(const FrameReport&)> on_frame;
    std::function<void(const CloudReport&)> on_cloud;  ///< after cleaning a scan
    std::function<void(MapUpdate)> on_update;
    std::function<void(const std::string&)> on_error;
    std::function<void(const CorrectionReport&)> on_correction = {};
  };

  /// Updates follow each other by at least `update_period_s` of wall time. The callbacks run in the
  /// worker's thread.
  MapWorker(LabelSet labels,
            const MapConfig& config,
            const CloudConfig& cloud,
            std::size_t queue_size,
            double update_period_s,
            Callbacks callbacks);
  ~MapWorker();
  MapWorker(const MapWorker&) = delete;
  MapWorker& operator=(const MapWorker&) = delete;

  /// False if the queue is full: the frame is lost. A scan is cleaned and thinned first.
  bool push(PointFrame frame, std::string sensor, bool is_scan);
  /// Corrected poses of keyframes, also of those that still wait. False if the queue is full.
  bool correct(PoseCorrections corrections);
  /// Forgets the map and what waits, and runs `on_reset`; no update of the old map is handed out
  /// afterwards.
  void reset(const std::function<void()>& on_reset);
  /// Frames that are not yet in the map: waiting or in the running update.
  std::size_t size() const;
  /// Bytes of memory that waiting frames hold.
  std::size_t bytes() const;
  /// Joins the thread after the running update.
  void stop();

 private:
  struct Item {
    PointFrame frame;
    std::string sensor;
    bool is_scan = false;
    std::shared_ptr<const PoseCorrections> corrections;  ///< instead of a frame
  };

  bool enqueue(Item item);
  void run();
  bool wait_for_frames(std::deque<Item>* frames, std::uint64_t* epoch);
  void integrate(std::deque<Item>* frames, std::uint64_t epoch);
  bool add_frames(std::deque<Item>* frames);
  void take(Item* item);
  MapUpdate describe_map() const;
  void clean_scan(PointFrame* frame);

  CloudConfig cloud_;
  std::size_t queue_size_;
  std::chrono::duration<double> update_period_;
  Callbacks callbacks_;
  mutable std::mutex mutex_;  // guards the six below
  std::condition_variable wake_;
  std::deque<Item> queue_;
  std::size_t in_work_ = 0;
  std::size_t bytes_in_work_ = 0;
  std::uint64_t epoch_ = 0;  // grows with each reset
  bool stopping_ = false;
  std::mutex publish_mutex_;  // an update is handed out before or after a reset, never across
  // Only the worker's thread touches these.
  LabeledMap map_;
  PoseCorrector corrector_;
  std::uint64_t map_epoch_ = 0;
  std::chrono::steady_clock::time_point next_update_;
  std::thread thread_;
};

}  // namespace facet_mapping
