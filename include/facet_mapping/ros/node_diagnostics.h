// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a node received, did and refused, on /diagnostics and in the log.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

namespace facet_mapping {

/// Thread-safe. Every reason for dropping something has a counter "problem: REASON"; the status is
/// WARN while a problem is fresh or an input has never come. Published every ~diagnostic_period
/// seconds (default 1).
class NodeDiagnostics {
 public:
  NodeDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

  /// An input without which the node has nothing to do; `topic` as resolved.
  void expect_input(const std::string& topic);
  void count_input(const std::string& topic);

  void count(const std::string& what, std::uint64_t by = 1);
  /// Counts under "problem: reason" and logs the sentence, each reason at most once in 5 s.
  void complain(const std::string& reason, const std::string& sentence);
  void set(const std::string& key, const std::string& value);
  void set(const std::string& key, double value);
  /// Called before each publication, to set values that are cheap to ask for.
  void on_publish(std::function<void()> refresh);

  std::uint64_t problems(const std::string& reason) const;

 private:
  struct Problem {
    std::uint64_t count = 0;
    ros::WallTime last;
    ros::WallTime last_logged;
    std::string sentence;
  };

  void fill(diagnostic_updater::DiagnosticStatusWrapper& status);
  std::string missing_inputs() const;

  mutable std::mutex mutex_;
  std::function<void()> refresh_;
  std::string name_;
  std::map<std::string, std::uint64_t> inputs_;
  std::map<std::string, std::uint64_t> counters_;
  std::map<std::string, Problem> problems_;
  std::map<std::string, std::string> values_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace facet_mapping
