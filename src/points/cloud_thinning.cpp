// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <unordered_map>
#include <utility>

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

/// Of the points `candidates`, those that have enough others among all points.
pcl::Indices drop_isolated(const Cloud& points,
                           pcl::Indices candidates,
                           const CloudConfig& config,
                           CloudReport& report) {
  if (candidates.empty() || config.outlier_radius_m == 0.0 || config.outlier_neighbors == 0) {
    return candidates;
  }
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Eigen::Vector3f& point : points) {
    cloud->emplace_back(point.x(), point.y(), point.z());
  }
  report.isolated = candidates.size();
  pcl::RadiusOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setIndices(std::make_shared<pcl::Indices>(std::move(candidates)));
  filter.setRadiusSearch(config.outlier_radius_m);
  filter.setMinNeighborsInRadius(config.outlier_neighbors);
  pcl::Indices kept;
  filter.filter(kept);
  report.isolated -= kept.size();
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
pcl::Indices thin(const Cloud& points, double voxel_m, CloudReport& report) {
  pcl::Indices kept;
  if (voxel_m == 0.0) {
    kept.resize(points.size());
    std::iota(kept.begin(), kept.end(), 0);
    return kept;
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
  kept.reserve(best.size());
  for (const auto& entry : best) {
    kept.push_back(static_cast<pcl::index_t>(entry.second));
  }
  std::sort(kept.begin(), kept.end());
  report.thinned = points.size() - kept.size();
  return kept;
}

}  // namespace

std::vector<LabeledPoint> thin_cloud(const std::vector<Eigen::Vector3f>& scan,
                                     const CloudConfig& config,
                                     CloudReport* report) {
  check_config(config);
  CloudReport counts;
  const Cloud candidates = select_range(scan, config, counts);
  // Thinned first: searching for the neighbours of every point of a scan takes most of the time.
  const pcl::Indices kept =
      drop_isolated(candidates, thin(candidates, config.voxel_m, counts), config, counts);
  std::vector<LabeledPoint> points;
  points.reserve(kept.size());
  for (const auto index : kept) {
    points.push_back({candidates[index], kUnlabelled, static_cast<float>(config.sigma_m)});
  }
  counts.points = points.size();
  if (report != nullptr) {
    *report = counts;
  }
  return points;
}

}  // namespace facet_mapping
