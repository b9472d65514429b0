// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scans wait here for the label image nearest to them in time.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>

#include <boost/shared_ptr.hpp>
#include <ros/time.h>

namespace facet_mapping {

/// All calls in one thread. Scans go on in the order in which they came.
class NearestLabels {
 public:
  struct Image {
    ros::Time stamp;
    boost::shared_ptr<const void> message;  ///< null: no image within the tolerance came in time
  };
  using Ready = std::function<void(const Image&)>;
  struct Config {
    double tolerance_s = 0.1;  ///< between the two stamps
    double timeout_s = 2.0;    ///< wall time that a scan waits
    double cache_s = 5.0;      ///< wall time that an image is kept
    std::size_t max_scans = 50;
  };

  explicit NearestLabels(const Config& config) : config_(config) {}

  /// Each may call `Ready` of scans that have waited.
  void add_image(const ros::Time& stamp,
                 boost::shared_ptr<const void> message,
                 const ros::WallTime& now);
  /// False, and nothing happens, if too many wait. `ready` is called once an image at or after
  /// `stamp` has come, so that none nearer can follow, or when the time is over.
  bool add_scan(const ros::Time& stamp, const ros::WallTime& now, Ready ready);
  void poll(const ros::WallTime& now);
  void clear();

  std::size_t waiting() const { return scans_.size(); }

 private:
  struct Scan {
    ros::Time stamp;
    ros::WallTime arrival;
    Ready ready;
  };
  struct Kept {
    boost::shared_ptr<const void> message;
    ros::WallTime arrival;
  };

  Image nearest(const ros::Time& stamp) const;

  Config config_;
  std::deque<Scan> scans_;
  std::map<ros::Time, Kept> images_;
};

}  // namespace facet_mapping
