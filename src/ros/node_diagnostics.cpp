// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/node_diagnostics.h"

#include <sstream>
#include <stdexcept>
#include <utility>

namespace facet_mapping {
namespace {

constexpr double kLogPeriodS = 5.0;      // of each reason
constexpr double kFreshProblemS = 10.0;  // how long a problem keeps the status at WARN
constexpr double kDefaultPeriodS = 1.0;
constexpr double kShortestPeriodS = 0.01;
constexpr double kLongestPeriodS = 3600.0;

ros::WallDuration publish_period(const ros::NodeHandle& private_nh) {
  const double period_s = private_nh.param("diagnostic_period", kDefaultPeriodS);
  if (!(period_s >= kShortestPeriodS && period_s <= kLongestPeriodS)) {
    throw std::invalid_argument("parameter ~diagnostic_period must lie between 0.01 and 3600 s");
  }
  return ros::WallDuration(period_s);
}

}  // namespace

NodeDiagnostics::NodeDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : name_(private_nh.getNamespace()), updater_(nh, private_nh, name_) {
  updater_.setHardwareID("none");
  updater_.add("mapping", this, &NodeDiagnostics::fill);
  timer_ = nh.createWallTimer(publish_period(private_nh), [this](const ros::WallTimerEvent&) {
    if (refresh_) {
      refresh_();
    }
    updater_.force_update();
  });
}

void NodeDiagnostics::on_publish(std::function<void()> refresh) {
  refresh_ = std::move(refresh);
}

void NodeDiagnostics::expect_input(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  inputs_.emplace(topic, 0);
}

void NodeDiagnostics::count_input(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++inputs_[topic];
}

void NodeDiagnostics::count(const std::string& what, std::uint64_t by) {
  const std::lock_guard<std::mutex> lock(mutex_);
  counters_[what] += by;
}

void NodeDiagnostics::complain(const std::string& reason, const std::string& sentence) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Problem& problem = problems_[reason];
  ++problem.count;
  problem.last = ros::WallTime::now();
  problem.sentence = sentence;
  if ((problem.last - problem.last_logged).toSec() < kLogPeriodS) {
    return;
  }
  problem.last_logged = problem.last;
  ROS_WARN("%s: %s [%s: %lu so far]",
           name_.c_str(),
           sentence.c_str(),
           reason.c_str(),
           static_cast<unsigned long>(problem.count));
}

void NodeDiagnostics::set(const std::string& key, const std::string& value) {
  const std::lock_guard<std::mutex> lock(mutex_);
  values_[key] = value;
}

void NodeDiagnostics::set(const std::string& key, double value) {
  std::ostringstream text;
  text << value;
  set(key, text.str());
}

std::uint64_t NodeDiagnostics::problems(const std::string& reason) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = problems_.find(reason);
  return found == problems_.end() ? 0 : found->second.count;
}

std::string NodeDiagnostics::missing_inputs() const {
  std::string missing;
  for (const auto& [topic, received] : inputs_) {
    if (received == 0) {
      missing += " " + topic;
    }
  }
  return missing;
}

void NodeDiagnostics::fill(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  using Level = diagnostic_msgs::DiagnosticStatus;
  status.summary(Level::OK, "running");
  const std::string missing = missing_inputs();
  if (!missing.empty()) {
    status.summary(Level::WARN, "nothing received yet on" + missing + "; check `rostopic hz`");
  }
  for (const auto& [topic, received] : inputs_) {
    status.add("received " + topic, received);
  }
  for (const auto& [what, times] : counters_) {
    status.add(what, times);
  }
  for (const auto& [key, value] : values_) {
    status.add(key, value);
  }
  for (const auto& [reason, problem] : problems_) {
    status.add("problem: " + reason, problem.count);
    if ((ros::WallTime::now() - problem.last).toSec() < kFreshProblemS) {
      status.summary(Level::WARN, problem.sentence);
    }
  }
}

}  // namespace facet_mapping
