// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <optional>

#include <yaml-cpp/yaml.h>

#include "facet_mapping/ros/transform_queue.h"

namespace facet_mapping {
namespace {

struct TimeRange {
  double oldest = 0.0;
  double newest = 1e300;
};

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3f", seconds);
  return text;
}

/// The times that tf knows for every moving link from the frame up to the map; nothing if the chain
/// does not reach the map.
std::optional<TimeRange> known_range(const YAML::Node& frames,
                                     const std::string& map_frame,
                                     std::string frame_id) {
  TimeRange range;
  for (std::size_t depth = 0; depth <= frames.size(); ++depth) {
    if (frame_id == map_frame) {
      return range;
    }
    const YAML::Node entry = frames[frame_id];
    if (!entry || !entry["parent"]) {
      return std::nullopt;
    }
    const auto newest = entry["most_recent_transform"].as<double>(0.0);
    if (newest > 0.0) {  // static transforms hold at all times
      range.oldest = std::max(range.oldest, entry["oldest_transform"].as<double>(0.0));
      range.newest = std::min(range.newest, newest);
    }
    frame_id = entry["parent"].as<std::string>();
  }
  return std::nullopt;
}

std::string what_tf_knows(const tf2_ros::Buffer& buffer,
                          const std::string& map_frame,
                          const std::string& frame_id) {
  const YAML::Node frames = YAML::Load(buffer.allFramesAsYAML());
  if (!frames.IsMap() || frames.size() == 0) {
    return "tf knows no frame at all: is the localisation (or the bag) publishing /tf?";
  }
  const std::optional<TimeRange> range = known_range(frames, map_frame, frame_id);
  if (!range) {
    return "the two are not connected; see `rosrun tf view_frames` and set map_frame to the "
           "root of your tree";
  }
  if (range->oldest > range->newest || range->newest > 1e299) {
    return "the links between them share no time; check the clocks of the publishers";
  }
  return "tf knows this chain from " + seconds_text(range->oldest) + " to " +
         seconds_text(range->newest) +
         "; check that stamps and tf come from the same clock (use_sim_time, rosbag play --clock) "
         "or raise tf_timeout_s";
}

}  // namespace

std::string explain_missing_transform(const tf2_ros::Buffer& buffer,
                                      const std::string& map_frame,
                                      const std::string& frame_id,
                                      const ros::Time& stamp,
                                      double waited_s,
                                      const std::string& error) {
  std::string known;
  try {
    known = what_tf_knows(buffer, map_frame, frame_id);
  } catch (const YAML::Exception&) {
    known = error;
  }
  return "no transform from '" + frame_id + "' to '" + map_frame + "' at " +
         seconds_text(stamp.toSec()) + " within " + seconds_text(waited_s) +
         " s, the frame is dropped: " + known;
}

}  // namespace facet_mapping
