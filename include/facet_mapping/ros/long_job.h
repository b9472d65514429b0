// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One long job at a time, for services that wait for it, can be cancelled and never hold up the end
// of the node.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace facet_mapping {

class LongJob {
 public:
  LongJob() = default;
  ~LongJob();
  LongJob(const LongJob&) = delete;
  LongJob& operator=(const LongJob&) = delete;

  /// Runs `job` in a thread of its own and waits for its end. Throws ServiceError with BUSY if one
  /// is running, with CANCELLED if stop() is called meanwhile (the job then ends unattended: it
  /// must own what it uses), and what the job throws.
  void run(const std::string& name, std::function<void()> job);

  /// Asks the running job to end; false if there is none.
  bool cancel();
  /// True if the running job shall end soon.
  bool is_cancelled() const { return cancelled_; }
  /// Name of the running job, "" if there is none.
  std::string running() const;

  /// Cancels, releases who waits, and joins the job's thread.
  void stop();

 private:
  struct Outcome;

  void start(const std::string& name,
             const std::shared_ptr<Outcome>& outcome,
             std::function<void()> job);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::string running_;
  bool stopping_ = false;
  std::atomic<bool> cancelled_{false};
  std::thread thread_;
};

}  // namespace facet_mapping
