// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The main function and the nodelet of a node class: the same class over two kinds of life.
#pragma once

#include <chrono>
#include <cstdlib>
#include <future>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include "facet_mapping/ros/node_config.h"

namespace facet_mapping {

/// Serves callbacks until the shutdown begins, which ros::spin() would only notice when it is over.
inline void spin_until_shutdown() {
  const ros::WallDuration kTimeout(0.1);
  while (ros::ok() && !ros::isShuttingDown()) {
    ros::getGlobalCallbackQueue()->callAvailable(kTimeout);
  }
}

/// Stops the node; false if its running job does not end within 1.5 s.
template <typename Node>
bool stop_in_time(Node* node) {
  std::packaged_task<void()> task([node] { node->stop(); });
  std::future<void> stopped = task.get_future();
  std::thread(std::move(task)).detach();
  return stopped.wait_for(std::chrono::milliseconds(1500)) == std::future_status::ready;
}

/// Runs a node until the end; `--parameters` prints its parameter table instead.
/// Returns 1 if the parameters cannot be used.
template <typename Node>
int run_node(int argc, char** argv, const std::string& name) {
  if (argc > 1 && std::string(argv[1]) == "--parameters") {
    typename Node::Config config;
    std::cout << parameter_table(&config).to_markdown();
    return 0;
  }
  ros::init(argc, argv, name);
  // The end of the last handle ends rosconsole, too, and with it the sentence below.
  const ros::NodeHandle keeps_the_log_open;
  std::unique_ptr<Node> node;
  try {
    node = std::make_unique<Node>(ros::NodeHandle(), ros::NodeHandle("~"));
  } catch (const std::exception& e) {
    ROS_FATAL("%s", e.what());
    return 1;
  }
  spin_until_shutdown();
  if (!stop_in_time(node.get())) {
    // The map in memory is all that is lost: files appear only when they are complete.
    ros::shutdown();
    std::cerr << name << ": left a running job unfinished\n";
    std::_Exit(0);
  }
  node.reset();
  ros::shutdown();
  return 0;
}

template <typename Node>
class NodeNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      node_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& e) {
      // An exception would end the manager and with it all other nodelets.
      NODELET_FATAL("%s", e.what());
    }
  }

  std::unique_ptr<Node> node_;
};

}  // namespace facet_mapping
