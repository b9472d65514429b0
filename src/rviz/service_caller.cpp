// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "service_caller.h"

#include <thread>

#include <ros/service.h>

namespace facet_mapping {
namespace {

// A client must not be shut down in the very moment in which its call begins.
constexpr std::chrono::milliseconds kTimeToBegin(50);

}  // namespace

std::unique_ptr<ros::ServiceClient> CallConnection::open(const std::string& service,
                                                         const std::string& md5sum) {
  if (!ros::service::exists(service, false)) {
    return nullptr;
  }
  constexpr bool kPersistent = true;  // else the connection is out of reach
  auto client = std::make_unique<ros::ServiceClient>(service, kPersistent, ros::M_string(), md5sum);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_broken_off_ || !client->isValid()) {
    return nullptr;
  }
  client_ = std::make_unique<ros::ServiceClient>(*client);
  opened_ = std::chrono::steady_clock::now();
  return client;
}

void CallConnection::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (client_) {
    client_->shutdown();
    client_ = nullptr;
  }
}

void CallConnection::break_off() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_broken_off_ = true;
  if (client_) {
    std::this_thread::sleep_until(opened_ + kTimeToBegin);
    client_->shutdown();
    client_ = nullptr;
  }
}

bool CallConnection::is_broken_off() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_broken_off_;
}

}  // namespace facet_mapping
