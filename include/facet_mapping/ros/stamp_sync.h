// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings the parts of a frame (images, camera_info, a segmentation that may come seconds later)
// together by exact stamp.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>
#include <ros/time.h>

namespace facet_mapping {

/// The parts of one instant; a null pointer where an optional part did not come.
struct StampedParts {
  ros::Time stamp;
  std::vector<boost::shared_ptr<const void>> parts;

  template <typename Message>
  boost::shared_ptr<const Message> get(std::size_t part) const {
    return boost::static_pointer_cast<const Message>(parts[part]);
  }
};

/// Frames go on in the order of their stamps, as far as each topic keeps to it: an optional part
/// that has come for a later stamp is not waited for any more (a slow network drops images).
class StampSync {
 public:
  struct Part {
    std::string name;
    bool required = true;
    double wait_s = 0.0;  ///< an optional part: how long the others wait for it at most
  };
  /// What became of frames that never were complete.
  struct Counts {
    std::size_t unpaired = 0;          ///< frames dropped: a required part never came
    std::vector<std::size_t> missing;  ///< per part: dropped or sent on without it
    std::size_t late = 0;              ///< parts that came after their frame had gone on
  };

  /// Frames are kept at most `cache_s` seconds and `max_frames` at once.
  StampSync(std::vector<Part> parts, double cache_s, std::size_t max_frames);

  /// Adds one message; returns the frames that are ready, in order of their stamps.
  std::vector<StampedParts> add(std::size_t part,
                                const ros::Time& stamp,
                                boost::shared_ptr<const void> message,
                                const ros::WallTime& now);
  /// Frames whose optional parts were waited for long enough; drops what is too old.
  std::vector<StampedParts> poll(const ros::WallTime& now);

  /// Forgets all frames that wait (after a jump of the clock).
  void clear();

  std::size_t waiting() const { return frames_.size(); }
  const Counts& counts() const { return counts_; }

 private:
  struct Frame {
    std::vector<boost::shared_ptr<const void>> parts;
    ros::WallTime first;     ///< arrival of the first part
    ros::WallTime complete;  ///< arrival of the last required part, zero before
  };

  bool is_ready(const ros::Time& stamp, const Frame& frame, const ros::WallTime& now) const;
  bool has_required(const Frame& frame) const;
  void count_missing(const Frame& frame);

  std::vector<Part> parts_;
  std::vector<ros::Time> last_;  // stamp of each part's last message
  double cache_s_;
  std::size_t max_frames_;
  std::map<ros::Time, Frame> frames_;
  std::map<ros::Time, ros::WallTime> done_;  // so that a late part is known as such
  Counts counts_;
};

}  // namespace facet_mapping
