// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ~keyframes: the keyframes that can still move.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <nav_msgs/Path.h>
#include <ros/node_handle.h>

#include "facet_mapping/mapping/labeled_map.h"

namespace facet_mapping {

using KeyframesPtr = std::shared_ptr<const std::map<KeyframeId, Keyframe>>;

/// One pose per keyframe: map_from_sensor at the keyframe's stamp, header.seq = its id.
nav_msgs::Path path_message(const std::map<KeyframeId, Keyframe>& keyframes,
                            const std::string& map_frame);

/// Like a latched topic, but without subscribers nothing is converted. Thread-safe.
class KeyframePath {
 public:
  KeyframePath(ros::NodeHandle private_nh, const std::string& map_frame);
  void publish(KeyframesPtr keyframes);

 private:
  std::string map_frame_;
  std::recursive_mutex mutex_;  // a subscriber's callback may run inside advertise()
  KeyframesPtr keyframes_;
  ros::Publisher publisher_;
};

}  // namespace facet_mapping
