// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/lidar_points_labels.h"

#include <cmath>
#include <utility>

namespace facet_mapping {

void NearestLabels::add_image(const ros::Time& stamp,
                              boost::shared_ptr<const void> message,
                              const ros::WallTime& now) {
  images_[stamp] = {std::move(message), now};
  poll(now);
}

bool NearestLabels::add_scan(const ros::Time& stamp, const ros::WallTime& now, Ready ready) {
  if (scans_.size() >= config_.max_scans) {
    return false;
  }
  scans_.push_back({stamp, now, std::move(ready)});
  poll(now);
  return true;
}

void NearestLabels::poll(const ros::WallTime& now) {
  while (!scans_.empty()) {
    const bool is_over = (now - scans_.front().arrival).toSec() >= config_.timeout_s;
    const bool is_known = !images_.empty() && images_.rbegin()->first >= scans_.front().stamp;
    if (!is_over && !is_known) {
      break;
    }
    const Scan scan = std::move(scans_.front());
    scans_.pop_front();
    scan.ready(nearest(scan.stamp));
  }
  for (auto image = images_.begin(); image != images_.end();) {
    const bool is_old = (now - image->second.arrival).toSec() > config_.cache_s;
    image = is_old ? images_.erase(image) : std::next(image);
  }
}

void NearestLabels::clear() {
  scans_.clear();
  images_.clear();
}

NearestLabels::Image NearestLabels::nearest(const ros::Time& stamp) const {
  Image best;
  double best_s = config_.tolerance_s;
  for (const auto& [image_stamp, kept] : images_) {
    const double distance_s = std::abs((image_stamp - stamp).toSec());
    if (distance_s <= best_s) {
      best_s = distance_s;
      best = {image_stamp, kept.message};
    }
  }
  return best;
}

}  // namespace facet_mapping
