// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a keyframe costs as the drive grows longer: a Markdown table, one line per tenth.
// Usage: long_drive [keyframes] [frozen_beyond_m] [memory_budget_mb] [keyframes per update]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "benchmark/processor_time.h"

#include "facet_mapping/geometry/manifold.h"
#include "facet_mapping/mapping/labeled_map.h"
#include "facet_mapping/ros/process_memory.h"
#include "facet_mapping/synthetic/street.h"
#include "facet_mapping/synthetic/street_lidar.h"
#include "facet_mapping/synthetic/street_raycaster.h"
#include "facet_mapping/synthetic/street_rig.h"

namespace facet_mapping {
namespace {

constexpr double kMiB = 1024.0 * 1024.0;

double resident_mib() {
  return static_cast<double>(process_memory().resident) / kMiB;
}

/// Scans of a bent street with the noise that stereo has at KITTI's focal length and baseline.
class Drive {
 public:
  explicit Drive(int keyframes)
      : street_(make_street(street_config(keyframes))), raycaster_(street_) {
    lidar_.beams = 40;
    lidar_.azimuth_step_deg = 0.4;
    lidar_.max_range_m = 40.0;
  }

  PointFrame frame(int k) const {
    constexpr float kSigmaPerSquareMetre = 0.00077F;  // 0.3 px
    constexpr float kLeastSigma = 0.02F;
    constexpr float kRoadBelow = -1.2F;  // metres, seen from the sensor
    std::mt19937 random(static_cast<unsigned>(k));
    std::normal_distribution<float> normal;
    PointFrame frame;
    frame.stamp = street_.trajectory[k].stamp;
    frame.world_from_sensor = street_.trajectory[k].map_from_left * kitti_rig(true).left_from_velo;
    for (const Eigen::Vector4f& hit :
         scan_street(street_, raycaster_, frame.world_from_sensor, lidar_, k)) {
      LabeledPoint point;
      const float range = hit.head<3>().norm();
      point.sigma = std::max(kLeastSigma, kSigmaPerSquareMetre * range * range);
      point.position = hit.head<3>() * (1.0F + 0.7F * normal(random) * point.sigma / range);
      point.label = hit.z() < kRoadBelow ? street_class::kRoad : street_class::kBuilding;
      frame.points.push_back(point);
    }
    return frame;
  }

 private:
  static StreetConfig street_config(int keyframes) {
    StreetConfig config;
    config.frames = keyframes;
    config.length_m = std::max(60.0, keyframes * config.frame_spacing_m + kStreetEndMargin);
    config.bend_rad = 0.3;
    return config;
  }

  Street street_;
  StreetRaycaster raycaster_;
  StreetLidarConfig lidar_;
};

LabelSet street_labels() {
  ClassInfo road;
  road.id = street_class::kRoad;
  road.name = "road";
  ClassInfo building;
  building.id = street_class::kBuilding;
  building.name = "building";
  building.color = {70, 70, 70};
  return LabelSet({road, building});
}

void print_line(int keyframes, double seconds, double peak, const LabeledMap& map, double base) {
  const CarvingStats stats = map.stats();
  std::printf("| %d | %.0f | %.0f | %zu | %zu | %.1f | %.0f | %.0f | %.2f | %s |\n",
              keyframes,
              1e3 * seconds,
              1e3 * peak,
              stats.vertices,
              stats.rays,
              100.0 * static_cast<double>(stats.reached_cells) /
                  static_cast<double>(std::max<std::size_t>(1, stats.free_cells)),
              static_cast<double>(map.bytes()) / kMiB,
              resident_mib() - base,
              map.range_scale(),
              check_manifold(map.mesh()).to_string().c_str());
  std::fflush(stdout);
}

void run(int keyframes, const MapConfig& config, int batch) {
  const Drive drive(keyframes);
  LabeledMap map(street_labels(), config);
  const double base = resident_mib();
  std::printf(
      "| keyframes | processor ms a keyframe | most of an update | vertices | rays | reached %% | "
      "MiB "
      "accounted | MiB resident | range scale | surface "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  double seconds = 0.0;
  double peak = 0.0;
  const int tenth = std::max(1, keyframes / 10);
  for (int k = 0; k < keyframes; ++k) {
    const PointFrame frame = drive.frame(k);
    const double start = benchmarking::processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    map.add(frame);
    if ((k + 1) % batch == 0 || (k + 1) % tenth == 0) {
      map.update();
    }
    const double cost = benchmarking::processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
    seconds += cost;
    peak = std::max(peak, cost);
    if ((k + 1) % tenth == 0) {
      print_line(k + 1, seconds / tenth, peak, map, base);
      seconds = 0.0;
      peak = 0.0;
    }
  }
}

}  // namespace
}  // namespace facet_mapping

int main(int argc, char** argv) {
  const auto argument = [&](int k, double otherwise) {
    return argc > k ? std::strtod(argv[k], nullptr) : otherwise;
  };
  facet_mapping::MapConfig config;
  config.frozen_beyond_m = argument(2, 60.0);
  config.memory_budget_mb = argument(3, 0.0);
  facet_mapping::run(
      static_cast<int>(argument(1, 300.0)), config, static_cast<int>(argument(4, 4.0)));
  return 0;
}
