// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/synthetic/street_dataset.h"

#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "dataset_files.h"
#include "random.h"
#include <tbb/parallel_for.h>

#include "facet_mapping/io/ply.h"
#include "facet_mapping/synthetic/segmentation_noise.h"
#include "facet_mapping/synthetic/street_rig.h"

namespace facet_mapping {
namespace {

constexpr float kDepthScale = 256.0F;  // PNG units per metre

void check(const StreetDatasetConfig& config) {
  if (!(config.gain_sigma >= 0.0 && config.gain_sigma <= 0.5) ||
      !(config.grey_sigma >= 0.0 && config.grey_sigma <= 100.0) ||
      !(config.label_noise >= 0.0 && config.label_noise <= 100.0)) {
    throw std::invalid_argument(
        "street dataset: give gain_sigma 0 to 0.5, grey_sigma 0 to 100 and label_noise 0 to 100");
  }
  check(config.lidar);
}

cv::Mat depth_png(const cv::Mat& depth) {
  cv::Mat png(depth.size(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float units = std::round(depth.at<float>(y, x) * kDepthScale);
      png.at<std::uint16_t>(y, x) =
          units < 65536.0F ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
    }
  }
  return png;
}

/// Everything that the frames share; frames are written in any order.
class FrameWriter {
 public:
  FrameWriter(const Street& street, const StreetDatasetConfig& config, const DatasetFiles& files)
      : street_(street),
        config_(config),
        files_(files),
        rig_(kitti_rig(config.full_size)),
        renderer_(street, config.view),
        raycaster_(config.scans ? std::make_unique<StreetRaycaster>(street) : nullptr) {}

  const StreetRig& rig() const { return rig_; }

  void write(std::size_t frame) const {
    const std::uint64_t seed = derive_seed(derive_seed(street_.config.seed, config_.seed), frame);
    const Eigen::Isometry3d& map_from_left = street_.trajectory[frame].map_from_left;
    const StreetImage left =
        renderer_.render(rig_.left_view(map_from_left), sensor_noise(derive_seed(seed, 0)));
    const StreetImage right =
        renderer_.render(rig_.right_view(map_from_left), sensor_noise(derive_seed(seed, 1)));
    files_.write_image("left", frame, left.color);
    files_.write_image("right", frame, right.color);
    files_.write_image("gt_depth", frame, depth_png(left.depth));
    files_.write_image("gt_label", frame, left.labels);
    files_.write_image("labels",
                       frame,
                       noisy_segmentation(left.labels, config_.label_noise, derive_seed(seed, 2)));
    if (raycaster_) {
      files_.write_scan(frame,
                        scan_street(street_,
                                    *raycaster_,
                                    map_from_left * rig_.left_from_velo,
                                    config_.lidar,
                                    derive_seed(seed, 3)));
    }
  }

 private:
  SensorNoise sensor_noise(std::uint64_t seed) const {
    Random random(seed);
    return {1.0 + config_.gain_sigma * random.normal(), config_.grey_sigma, random.bits()};
  }

  const Street& street_;
  const StreetDatasetConfig& config_;
  const DatasetFiles& files_;
  StreetRig rig_;
  StreetRenderer renderer_;
  std::unique_ptr<StreetRaycaster> raycaster_;
};

}  // namespace

LabelSet street_labels() {
  const auto info = [](Label id, const char* name, const Rgb& color) {
    ClassInfo entry;
    entry.id = id;
    entry.name = name;
    entry.color = color;
    entry.sky = id == street_class::kSky;
    return entry;
  };
  return LabelSet({info(street_class::kRoad, "road", {128, 64, 128}),
                   info(street_class::kSidewalk, "sidewalk", {244, 35, 232}),
                   info(street_class::kBuilding, "building", {70, 70, 70}),
                   info(street_class::kPole, "pole", {153, 153, 153}),
                   info(street_class::kTrafficSign, "traffic sign", {220, 220, 0}),
                   info(street_class::kVegetation, "vegetation", {107, 142, 35}),
                   info(street_class::kTerrain, "terrain", {152, 251, 152}),
                   info(street_class::kSky, "sky", {70, 130, 180}),
                   info(street_class::kCar, "car", {0, 0, 142})});
}

void write_street_dataset(const Street& street,
                          const StreetDatasetConfig& config,
                          const std::string& folder,
                          const StreetProgress& progress) {
  check(config);
  if (street.trajectory.empty()) {
    throw std::invalid_argument("street dataset: the street has no trajectory");
  }
  const std::size_t total = street.trajectory.size();
  const DatasetFiles files(folder, total);
  const FrameWriter writer(street, config, files);
  write_ply(files.path("ground_truth.ply"), {street.mesh, street_labels(), "map"});
  files.write_calibration(writer.rig());
  files.write_times(street.trajectory);
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, total, [&](std::size_t frame) {
    writer.write(frame);
    const std::lock_guard<std::mutex> lock(mutex);
    ++done;
    if (progress) {
      progress(done, total);
    }
  });
  files.write_poses(street.trajectory);
}

}  // namespace facet_mapping
