// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_lidar.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "random.h"
#include "surface_sampler.h"
#include "texture.h"
#include <tbb/parallel_for.h>

namespace facet_mapping {
namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
constexpr double kSpotPerMetre = 0.003;  // the beam's width grows with the range, radians

class Scanner {
 public:
  Scanner(const Street& street,
          const StreetRaycaster& raycaster,
          const Eigen::Isometry3d& map_from_velo,
          const StreetLidarConfig& config)
      : sampler_(street), raycaster_(raycaster), map_from_velo_(map_from_velo), config_(config) {}

  std::vector<Eigen::Vector4f> beam(int index, std::uint64_t seed) {
    Random random(derive_seed(seed, static_cast<std::uint64_t>(index)));
    const double share = config_.beams > 1 ? static_cast<double>(index) / (config_.beams - 1) : 0.5;
    const double elevation =
        kRadiansPerDegree *
        (config_.lowest_deg + share * (config_.highest_deg - config_.lowest_deg));
    const int half = static_cast<int>(config_.half_sector_deg / config_.azimuth_step_deg);
    std::vector<Eigen::Vector4f> points;
    for (int k = -half; k <= half; ++k) {
      const double azimuth = kRadiansPerDegree * config_.azimuth_step_deg * k;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      const auto point = shot(direction, &random);
      if (point) {
        points.push_back(*point);
      }
    }
    return points;
  }

 private:
  /// Draws the same count of random numbers for every shot, so that one return does not change
  /// the next.
  std::optional<Eigen::Vector4f> shot(const Eigen::Vector3d& direction, Random* random) {
    const double error = config_.range_sigma_m * random->normal();
    const double luck = random->uniform();
    const Eigen::Vector3d ray = map_from_velo_.linear() * direction;
    const auto hit = raycaster_.cast(map_from_velo_.translation(), ray);
    if (!hit || hit->distance > config_.max_range_m) {
      return std::nullopt;
    }
    const Eigen::Vector3d surface = map_from_velo_.translation() + hit->distance * ray;
    const SurfaceSample sample = sampler_.at(hit->facet, surface);
    const auto spot = static_cast<float>(0.002 + kSpotPerMetre * hit->distance);
    const Eigen::Vector3f color = reflectance(*sample.material, sample.texture, spot);
    if (luck < lost_share(sample, color)) {
      return std::nullopt;
    }
    const float cosine = std::abs(sampler_.facet_normal().dot(ray.cast<float>()));
    const float intensity = color.mean() * (0.4F + 0.6F * cosine);
    const Eigen::Vector3d point = (hit->distance + error) * direction;
    return Eigen::Vector4f(static_cast<float>(point.x()),
                           static_cast<float>(point.y()),
                           static_cast<float>(point.z()),
                           std::clamp(intensity, 0.0F, 1.0F));
  }

  double lost_share(const SurfaceSample& sample, const Eigen::Vector3f& color) const {
    const MaterialKind kind = sample.material->kind;
    const bool may_be_glass = kind == MaterialKind::kWindow || kind == MaterialKind::kCarBody;
    // Panes are darker than frames, curtains and most paint; black paint swallows light as well.
    return may_be_glass && color.mean() < 0.12F ? std::max(config_.glass_dropout, config_.dropout)
                                                : config_.dropout;
  }

  SurfaceSampler sampler_;
  const StreetRaycaster& raycaster_;
  const Eigen::Isometry3d& map_from_velo_;
  const StreetLidarConfig& config_;
};

bool in_range(double value, double low, double high) {
  return value >= low && value <= high;
}

}  // namespace

void check(const StreetLidarConfig& c) {
  const bool valid = in_range(c.beams, 1, 1024) && in_range(c.lowest_deg, -89.0, c.highest_deg) &&
                     in_range(c.highest_deg, c.lowest_deg, 89.0) &&
                     in_range(c.half_sector_deg, 0.0, 180.0) &&
                     in_range(c.azimuth_step_deg, 0.01, 90.0) &&
                     in_range(c.max_range_m, 0.1, 1e4) && in_range(c.range_sigma_m, 0.0, 10.0) &&
                     in_range(c.dropout, 0.0, 1.0) && in_range(c.glass_dropout, 0.0, 1.0);
  if (!valid) {
    throw std::invalid_argument(
        "street lidar: give 1 to 1024 beams between -89 and 89 degrees, lowest first, an azimuth "
        "step of 0.01 to 90 degrees, a positive range, a sigma of 0 to 10 m and shares in [0, 1]");
  }
}

std::vector<Eigen::Vector4f> scan_street(const Street& street,
                                         const StreetRaycaster& raycaster,
                                         const Eigen::Isometry3d& map_from_velo,
                                         const StreetLidarConfig& config,
                                         std::uint64_t seed) {
  check(config);
  std::vector<std::vector<Eigen::Vector4f>> beams(static_cast<std::size_t>(config.beams));
  tbb::parallel_for(0, config.beams, [&](int k) {
    beams[static_cast<std::size_t>(k)] =
        Scanner(street, raycaster, map_from_velo, config).beam(k, seed);
  });
  std::vector<Eigen::Vector4f> scan;
  for (const auto& beam : beams) {
    scan.insert(scan.end(), beam.begin(), beam.end());
  }
  return scan;
}

}  // namespace facet_mapping
