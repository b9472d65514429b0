// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "rules.h"
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "facet_mapping/points/lidar_points.h"

namespace facet_mapping {
namespace {

using Cloud = std::vector<Eigen::Vector3f>;

void check_config(const CloudConfig& config) {
  detail::Rules rules;
  rules.require(config.min_range_m >= 0.0 && config.max_range_m > config.min_range_m &&
                    config.max_range_m <= 1e4,
                "min_range_m must be at least 0 and below max_range_m, which is at most 10000");
  rules.require(config.outlier_radius_m >= 0.0, "outlier_radius_m must not be negative");
  rules.require(config.outlier_neighbors >= 0, "outlier_neighbors must not be negative");
  rules.require(config.voxel_m == 0.0 || (config.voxel_m >= 0.01 && config.voxel_m <= 1e4),
                "voxel_m must be 0 or from 0.01 to 10000");
  rules.require(config.sigma_m >= 0.0 && std::isfinite(config.sigma_m),
                "sigma_m must not be negative");
  rules.throw_if_broken("The cloud configuration is not usable: ");
}

Cloud select_range(const Cloud& scan, const CloudConfig& config, CloudReport& report) {
  Cloud kept;
  kept.reserve(scan.size());
  for (const Eigen::Vector3f& point : scan) {
    const double range = point.cast<double>().norm();
    if (!std::isfinite(range)) {
      ++report.not_finite;
    } else if (range < config.min_range_m || range > config.max_range_m) {
      ++report.out_of_range;
    } else {
      kept.push_back(point);
    }
  }
  return kept;
}

Cloud drop_isolated(Cloud points, const CloudConfig& config, CloudReport& report) {
  if (points.empty() || config.outlier_radius_m == 0.0 || config.outlier_neighbors == 0) {
    return points;
  }
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Eigen::Vector3f& point : points) {
    cloud->emplace_back(point.x(), point.y(), point.z());
  }
  pcl::RadiusOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setRadiusSearch(config.outlier_radius_m);
  filter.setMinNeighborsInRadius(config.outlier_neighbors);
  pcl::Indices indices;
  filter.filter(indices);
  Cloud kept;
  kept.reserve(indices.size());
  for (const auto index : indices) {
    kept.push_back(points[index]);
  }
  report.isolated = points.size() - kept.size();
  return kept;
}

/// Number of the cube that a point lies in. Ranges and cube sizes are checked so that each
/// coordinate fits 21 bits; PCL's own grid filters count in 32 bits and give up on wide scans.
std::uint64_t voxel_of(const Eigen::Vector3f& point, float voxel) {
  constexpr std::int64_t kOffset = 1LL << 20;
  std::uint64_t key = 0;
  for (const float coordinate : point) {
    const auto cell = static_cast<std::int64_t>(std::floor(coordinate / voxel)) + kOffset;
    key = (key << 21U) | static_cast<std::uint64_t>(cell);
  }
  return key;
}

float distance_from_center(const Eigen::Vector3f& point, float voxel) {
  const Eigen::Array3f in_voxel = point.array() / voxel - (point.array() / voxel).floor();
  return (in_voxel - 0.5F).matrix().squaredNorm();
}

/// One measured point per cube, the nearest to its centre, in the order of the input.
Cloud thin(Cloud points, double voxel_m, CloudReport& report) {
  if (voxel_m == 0.0) {
    return points;
  }
  const auto voxel = static_cast<float>(voxel_m);
  std::unordered_map<std::uint64_t, std::size_t> best;  // voxel -> index of its point
  best.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [entry, is_new] = best.emplace(voxel_of(points[i], voxel), i);
    if (!is_new && distance_from_center(points[i], voxel) <
                       distance_from_center(points[entry->second], voxel)) {
      entry->second = i;
    }
  }
  Cloud kept;
  kept.reserve(best.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (best.at(voxel_of(points[i], voxel)) == i) {
      kept.push_back(points[i]);
    }
  }
  report.thinned = points.size() - kept.size();
  return kept;
}

}  // namespace

std::vector<LabeledPoint> thin_cloud(const std::vector<Eigen::Vector3f>& scan,
                                     const CloudConfig& config,
                                     CloudReport* report) {
  check_config(config);
  CloudReport counts;
  const Cloud kept = thin(
      drop_isolated(select_range(scan, config, counts), config, counts), config.voxel_m, counts);
  std::vector<LabeledPoint> points;
  points.reserve(kept.size());
  for (const Eigen::Vector3f& position : kept) {
    points.push_back({position, kUnlabelled, static_cast<float>(config.sigma_m)});
  }
  counts.points = points.size();
  if (report != nullptr) {
    *report = counts;
  }
  return points;
}

}  // namespace facet_mapping
