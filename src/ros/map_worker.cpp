// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/map_worker.h"

#include <exception>
#include <utility>

#include <malloc.h>

namespace facet_mapping {

using Clock = std::chrono::steady_clock;

namespace {

std::size_t bytes_of(const PointFrame& frame) {
  return frame.points.capacity() * sizeof(LabeledPoint);
}

}  // namespace

MapWorker::MapWorker(LabelSet labels,
                     const MapConfig& config,
                     const CloudConfig& cloud,
                     std::size_t queue_size,
                     double update_period_s,
                     Callbacks callbacks)
    : cloud_(cloud),
      queue_size_(queue_size),
      update_period_(update_period_s),
      callbacks_(std::move(callbacks)),
      map_(std::move(labels), config),
      next_update_(Clock::now()),
      thread_([this] { run(); }) {}

MapWorker::~MapWorker() {
  stop();
}

bool MapWorker::push(PointFrame frame, std::string sensor, bool is_scan) {
  return enqueue({std::move(frame), std::move(sensor), is_scan, nullptr});
}

bool MapWorker::correct(PoseCorrections corrections) {
  Item item;
  item.corrections = std::make_shared<const PoseCorrections>(std::move(corrections));
  return enqueue(std::move(item));
}

bool MapWorker::enqueue(Item item) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (queue_.size() >= queue_size_ || stopping_) {
      return false;
    }
    queue_.push_back(std::move(item));
  }
  wake_.notify_one();
  return true;
}

void MapWorker::reset(const std::function<void()>& on_reset) {
  const std::lock_guard<std::mutex> publish_lock(publish_mutex_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    queue_.clear();
    ++epoch_;
  }
  on_reset();
}

std::size_t MapWorker::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return queue_.size() + in_work_;
}

std::size_t MapWorker::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t bytes = bytes_in_work_;
  for (const Item& item : queue_) {
    bytes += bytes_of(item.frame);
  }
  return bytes;
}

void MapWorker::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) {
    thread_.join();
  }
}

bool MapWorker::wait_for_frames(std::deque<Item>* frames, std::uint64_t* epoch) {
  std::unique_lock<std::mutex> lock(mutex_);
  wake_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
  wake_.wait_until(lock, next_update_, [this] { return stopping_; });
  frames->swap(queue_);
  in_work_ = frames->size();
  for (const Item& item : *frames) {
    bytes_in_work_ += bytes_of(item.frame);
  }
  *epoch = epoch_;
  return !stopping_;
}

void MapWorker::run() {
  std::deque<Item> frames;
  std::uint64_t epoch = 0;
  while (wait_for_frames(&frames, &epoch)) {
    next_update_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(update_period_);
    try {
      integrate(&frames, epoch);
    } catch (const std::exception& e) {
      callbacks_.on_error(e.what());
    }
    frames.clear();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      in_work_ = 0;
      bytes_in_work_ = 0;
    }
  }
}

void MapWorker::clean_scan(PointFrame* frame) {
  std::vector<Eigen::Vector3f> scan;
  scan.reserve(frame->points.size());
  for (const LabeledPoint& point : frame->points) {
    scan.push_back(point.position);
  }
  CloudReport report;
  frame->points = thin_cloud(scan, cloud_, &report);
  callbacks_.on_cloud(report);
}

bool MapWorker::add_frames(std::deque<Item>* frames) {
  for (Item& item : *frames) {
    try {
      take(&item);
    } catch (const std::invalid_argument& e) {
      callbacks_.on_error(e.what());
    }
  }
  return map_.pending() > 0;
}

void MapWorker::take(Item* item) {
  if (item->corrections) {
    const CorrectionReport report = corrector_.apply(*item->corrections, &map_);
    if (callbacks_.on_correction) {
      callbacks_.on_correction(report);
    }
    return;
  }
  if (item->is_scan) {
    clean_scan(&item->frame);
  }
  callbacks_.on_frame(map_.add(item->frame, item->sensor));
  corrector_.note(map_);
  item->frame.points = {};  // the map has its own copy
}

MapUpdate MapWorker::describe_map() const {
  MapUpdate update;
  update.surface = map_.surface();
  update.stats = map_.stats();
  update.keyframes = map_.keyframes();
  update.stamp = map_.last_stamp();
  update.line = map_.freeze_line();
  update.range_scale = map_.range_scale();
  update.map_bytes = map_.bytes() + corrector_.bytes();
  update.movable = std::make_shared<const std::map<KeyframeId, Keyframe>>(map_.movable_keyframes());
  return update;
}

void MapWorker::integrate(std::deque<Item>* frames, std::uint64_t epoch) {
  if (epoch != map_epoch_) {
    map_.reset();
    corrector_.clear();
    map_epoch_ = epoch;
  }
  const auto start = Clock::now();
  if (!add_frames(frames) || !map_.update()) {
    return;
  }
  if (map_.freeze_line().is_limited()) {
    malloc_trim(0);  // what the map forgot goes back to the system
  }
  MapUpdate update = describe_map();
  update.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const std::lock_guard<std::mutex> publish_lock(publish_mutex_);
  bool is_current = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_current = epoch == epoch_ && !stopping_;
  }
  if (is_current) {
    callbacks_.on_update(std::move(update));
  }
}

}  // namespace facet_mapping
