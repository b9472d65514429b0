// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/lidar_points_scan.h"

#include <algorithm>
#include <utility>

#include "facet_mapping/ros/cloud_conversions.h"

namespace facet_mapping {
namespace {

using sensor_msgs::PointField;

constexpr const char* kTimeFields[] = {
    "time", "t", "offset_time", "time_offset", "timestamp", "time_stamp"};

const PointField* find_field(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  const auto found = std::find_if(cloud.fields.begin(),
                                  cloud.fields.end(),
                                  [&](const PointField& field) { return field.name == name; });
  return found == cloud.fields.end() ? nullptr : &*found;
}

/// The field to read; "" for none.
std::string time_field(const sensor_msgs::PointCloud2& cloud, const std::string& wanted) {
  if (wanted == "none") {
    return "";
  }
  if (wanted != "auto") {
    return wanted;
  }
  for (const char* name : kTimeFields) {
    if (find_field(cloud, name) != nullptr) {
      return name;
    }
  }
  return "";
}

/// Integers are nanoseconds with the drivers that we know, floats are seconds.
PointTimeConfig time_config(const PointField& field, const PointTimeInput& input) {
  const bool is_float =
      field.datatype == PointField::FLOAT32 || field.datatype == PointField::FLOAT64;
  PointTimeConfig config;
  config.unit = input.unit;
  config.usual_unit = is_float ? TimeUnit::kSeconds : TimeUnit::kNanoseconds;
  config.usually_absolute = field.name == "timestamp" || field.name == "time_stamp";
  config.max_scan_s = input.max_scan_s;
  return config;
}

}  // namespace

LidarScan scan_from_cloud(const sensor_msgs::PointCloud2& cloud,
                          const PointTimeInput& config,
                          CloudTimes* times) {
  CloudTimes result;
  result.field = time_field(cloud, config.field);
  const std::vector<LabeledPoint> points = points_from_cloud(cloud);
  std::vector<double> all_times;
  if (!result.field.empty()) {
    all_times = values_from_cloud(cloud, result.field);
  }
  LidarScan scan;
  scan.stamp = cloud.header.stamp.toSec();
  std::vector<double> raw;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].position.allFinite() || points[i].position.isZero(0.0F)) {
      ++result.no_return;
      continue;
    }
    scan.points.push_back(points[i].position);
    if (!all_times.empty()) {
      raw.push_back(all_times[i]);
    }
  }
  if (!raw.empty()) {
    result.times =
        point_times(raw, scan.stamp, time_config(*find_field(cloud, result.field), config));
    scan.offsets_s = std::move(result.times.offsets_s);
  }
  if (times != nullptr) {
    *times = std::move(result);
  }
  return scan;
}

}  // namespace facet_mapping
