// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ROS service calls that neither stop the window nor keep it from closing.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "background_job.h"
#include <ros/service_client.h>
#include <ros/service_traits.h>

namespace facet_mapping {

/// The connection of one call. Its server's answer may take for ever, and roscpp cannot be told to
/// stop waiting; but when the connection is closed, the waiting ends.
class CallConnection {
 public:
  /// Null if nobody offers the service, or the call was broken off already.
  std::unique_ptr<ros::ServiceClient> open(const std::string& service, const std::string& md5sum);
  void close();
  /// From another thread than the call's.
  void break_off();
  bool is_broken_off() const;

 private:
  mutable std::mutex mutex_;
  std::unique_ptr<ros::ServiceClient> client_;
  std::chrono::steady_clock::time_point opened_;
  bool is_broken_off_ = false;
};

/// Calls one at a time, in a thread of its own.
template <typename Service>
class ServiceCaller {
 public:
  struct Outcome {
    std::string problem;  ///< why there is no answer; empty: there is one
    typename Service::Response response;
  };

  ServiceCaller() = default;
  ServiceCaller(const ServiceCaller&) = delete;
  ServiceCaller& operator=(const ServiceCaller&) = delete;
  ServiceCaller(ServiceCaller&&) = delete;
  ServiceCaller& operator=(ServiceCaller&&) = delete;
  ~ServiceCaller() {
    constexpr std::chrono::milliseconds kPatience(1000);
    if (is_running()) {
      break_off();
      job_.wait(kPatience);  // else the thread ends on its own, some time
    }
  }

  /// Must not be called while a call is running.
  void call(const std::string& service, typename Service::Request request) {
    connection_ = std::make_shared<CallConnection>();
    job_.start([connection = connection_, service, sent = std::move(request)] {
      return answer_of(connection.get(), service, sent);
    });
  }
  bool is_running() const { return job_.is_running(); }
  std::optional<Outcome> take() { return job_.take(); }
  /// The server goes on, but its answer will not be waited for.
  void break_off() {
    if (connection_) {
      connection_->break_off();
    }
  }

 private:
  static Outcome answer_of(CallConnection* connection,
                           const std::string& service,
                           const typename Service::Request& request) {
    Outcome outcome;
    const std::string md5sum = ros::service_traits::md5sum<Service>();
    const std::unique_ptr<ros::ServiceClient> client = connection->open(service, md5sum);
    if (!client) {
      outcome.problem = "nobody answers on " + service;
    } else if (!client->call(request, outcome.response, md5sum)) {
      outcome.problem = connection->is_broken_off()
                            ? "no longer waiting for the answer of " + service
                            : service +
                                  " broke off without an answer: the node has ended, or is "
                                  "of another version of facet_mapping";
    }
    connection->close();
    return outcome;
  }

  std::shared_ptr<CallConnection> connection_;
  BackgroundJob<Outcome> job_;
};

}  // namespace facet_mapping
