// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bounded queue of jobs with one thread that does them in order.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace facet_mapping {

class JobQueue {
 public:
  using Job = std::function<void()>;
  using OnError = std::function<void(const std::string&)>;

  /// `on_error` is told what() of exceptions that leave a job.
  JobQueue(std::size_t capacity, OnError on_error);
  ~JobQueue();
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  /// False, and nothing happens, if the queue is full or stopped.
  bool post(Job job);
  /// Jobs that wait, without the running one.
  std::size_t size() const;
  /// Drops what waits and joins the thread after the running job.
  void stop();

 private:
  void run();

  std::size_t capacity_;
  OnError on_error_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Job> jobs_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace facet_mapping
