// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/long_job.h"

#include <exception>
#include <utility>

#include "facet_mapping/ros/service_status.h"

namespace facet_mapping {

struct LongJob::Outcome {
  bool done = false;
  std::exception_ptr error;
};

LongJob::~LongJob() {
  stop();
}

void LongJob::start(const std::string& name,
                    const std::shared_ptr<Outcome>& outcome,
                    std::function<void()> job) {
  if (thread_.joinable()) {
    thread_.join();  // the last job, which has ended
  }
  running_ = name;
  cancelled_ = false;
  thread_ = std::thread([this, outcome, job = std::move(job)] {
    std::exception_ptr error;
    try {
      job();
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    outcome->error = error;
    outcome->done = true;
    running_.clear();
    changed_.notify_all();
  });
}

void LongJob::run(const std::string& name, std::function<void()> job) {
  const auto outcome = std::make_shared<Outcome>();
  std::unique_lock<std::mutex> lock(mutex_);
  if (stopping_) {
    throw ServiceError(Status::CANCELLED, "the node is shutting down");
  }
  if (!running_.empty()) {
    throw ServiceError(Status::BUSY,
                       running_ + " is running; wait for it or call ~cancel_refine first");
  }
  start(name, outcome, std::move(job));
  changed_.wait(lock, [&] { return outcome->done || stopping_; });
  if (!outcome->done) {
    throw ServiceError(Status::CANCELLED, "the node is shutting down");
  }
  if (outcome->error) {
    std::rethrow_exception(outcome->error);
  }
}

bool LongJob::cancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  cancelled_ = !running_.empty();
  return cancelled_;
}

std::string LongJob::running() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return running_;
}

void LongJob::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    cancelled_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) {
    thread_.join();
  }
}

}  // namespace facet_mapping
