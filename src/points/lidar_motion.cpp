// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/points/lidar_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "rules.h"

namespace facet_mapping {
namespace {

struct Interval {
  double first = std::numeric_limits<double>::infinity();  // seconds
  double last = -std::numeric_limits<double>::infinity();  // seconds

  bool empty() const { return first > last; }
  void add(double time) {
    first = std::min(first, time);
    last = std::max(last, time);
  }
};

std::string range_text(double first, double last) {
  char text[80];
  std::snprintf(text, sizeof(text), "%.3f to %.3f s", first, last);
  return text;
}

void check_input(const LidarScan& scan, double split_m) {
  detail::Rules rules;
  rules.require(std::isfinite(scan.stamp), "the scan's stamp is not finite");
  rules.require(scan.offsets_s.empty() || scan.offsets_s.size() == scan.points.size(),
                "there are " + std::to_string(scan.offsets_s.size()) + " time offsets for " +
                    std::to_string(scan.points.size()) + " points");
  rules.require(split_m >= 0.0, "split_m must not be negative");
  rules.throw_if_broken("The scan cannot be compensated: ");
}

double offset_of(const LidarScan& scan, std::size_t point) {
  return scan.offsets_s.empty() ? 0.0 : scan.offsets_s[point];
}

Interval times_of(const LidarScan& scan) {
  Interval times;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (std::isfinite(offset_of(scan, i))) {
      times.add(scan.stamp + offset_of(scan, i));
    }
  }
  return times;
}

Eigen::Isometry3d pose_at(const SensorPath& path, double stamp, const Interval& needed) {
  const std::optional<Eigen::Isometry3d> pose = path.at(stamp);
  if (!pose) {
    throw std::invalid_argument(
        "The scan cannot be compensated: it needs the sensor's poses from " +
        range_text(needed.first, needed.last) + ", but they are known from " +
        range_text(path.first(), path.last()) +
        " only, or with gaps; publish poses more often or longer");
  }
  return *pose;
}

/// Which part each instant belongs to, and the instant that each part is expressed at.
class Parts {
 public:
  Parts(const SensorPath& path, const Interval& times, double stamp, double split_m)
      : path_(path), start_m_(path.way_m(times.first)) {
    const double way_m = path.way_m(times.last) - start_m_;
    const std::size_t count =
        split_m > 0.0 && way_m > split_m ? static_cast<std::size_t>(std::ceil(way_m / split_m)) : 1;
    part_m_ = way_m / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double middle_m = start_m_ + (static_cast<double>(k) + 0.5) * part_m_;
      stamps_.push_back(count == 1 ? stamp : path.stamp_at(middle_m));
    }
  }

  const std::vector<double>& stamps() const { return stamps_; }

  std::size_t part_of(double time) const {
    if (stamps_.size() == 1) {
      return 0;
    }
    const double parts = std::max(0.0, (path_.way_m(time) - start_m_) / part_m_);
    return std::min(static_cast<std::size_t>(parts), stamps_.size() - 1);
  }

 private:
  const SensorPath& path_;
  double start_m_ = 0.0;
  double part_m_ = 0.0;
  std::vector<double> stamps_;
};

/// Carries points to the frame of their part. Points of one instant (a column of a spinning sensor)
/// follow each other, so the last instant's transform is kept.
class Carrier {
 public:
  Carrier(const SensorPath& path, const Parts& cut, const Interval& needed)
      : path_(path), cut_(cut), needed_(needed) {
    for (const double stamp : cut.stamps()) {
      parts_.push_back({stamp, pose_at(path, stamp, needed), {}});
    }
  }

  void carry(const Eigen::Vector3f& point, double time) {
    if (time != time_) {
      time_ = time;
      part_ = cut_.part_of(time);
      part_from_sensor_ =
          parts_[part_].world_from_sensor.inverse(Eigen::Isometry) * pose_at(path_, time, needed_);
    }
    parts_[part_].points.emplace_back((part_from_sensor_ * point.cast<double>()).cast<float>());
  }

  std::vector<CompensatedScan> take() {
    const auto is_empty = [](const CompensatedScan& part) { return part.points.empty(); };
    parts_.erase(std::remove_if(parts_.begin(), parts_.end(), is_empty), parts_.end());
    return std::move(parts_);
  }

 private:
  const SensorPath& path_;
  const Parts& cut_;
  Interval needed_;
  std::vector<CompensatedScan> parts_;
  double time_ = std::numeric_limits<double>::quiet_NaN();
  std::size_t part_ = 0;
  Eigen::Isometry3d part_from_sensor_ = Eigen::Isometry3d::Identity();
};

}  // namespace

std::vector<CompensatedScan> compensate_motion(const LidarScan& scan,
                                               const SensorPath& path,
                                               double split_m,
                                               MotionReport* report) {
  check_input(scan, split_m);
  MotionReport counts;
  std::vector<CompensatedScan> parts;
  const Interval times = times_of(scan);
  if (!times.empty()) {
    counts.seconds = times.last - times.first;
    counts.moved_m = path.way_m(times.last) - path.way_m(times.first);
    Interval needed = times;
    needed.add(scan.stamp);
    const Parts cut(path, times, scan.stamp, split_m);
    Carrier carrier(path, cut, needed);
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const double offset_s = offset_of(scan, i);
      if (std::isfinite(offset_s)) {
        carrier.carry(scan.points[i], scan.stamp + offset_s);
      } else {
        ++counts.without_time;
      }
    }
    parts = carrier.take();
  } else {
    counts.without_time = scan.points.size();
  }
  if (report != nullptr) {
    *report = counts;
  }
  return parts;
}

}  // namespace facet_mapping
