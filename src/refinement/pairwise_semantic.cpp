// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/pairwise_semantic.h"

#include <array>
#include <optional>

#include "pixel_forces.h"
#include "sum_over_pairs.h"

#include "facet_mapping/refinement/spline_image.h"
#include "facet_mapping/refinement/surface_warp.h"

namespace facet_mapping {
namespace {

/// One class's smooth mask at a point: its value and its change along the motion.
struct MaskSample {
  Label label = kUnlabelled;
  float value = 0.0F;
  float slope = 0.0F;
};

/// The smooth masks of all classes around a point; at most 16 differ.
class MaskSamples {
 public:
  MaskSamples(const cv::Mat& labels, const WarpedPoint& point) {
    const int column = static_cast<int>(point.pixel.x());
    const int row = static_cast<int>(point.pixel.y());
    const CubicBasis bx(static_cast<float>(point.pixel.x() - column));
    const CubicBasis by(static_cast<float>(point.pixel.y() - row));
    const auto motion_x = static_cast<float>(point.motion.x());
    const auto motion_y = static_cast<float>(point.motion.y());
    for (int v = 0; v < 4; ++v) {
      const Label* line = labels.ptr<Label>(row - 1 + v) + column - 1;
      for (int u = 0; u < 4; ++u) {
        MaskSample& sample = find(line[u]);
        sample.value += bx.weight[u] * by.weight[v];
        sample.slope +=
            bx.slope[u] * by.weight[v] * motion_x + bx.weight[u] * by.slope[v] * motion_y;
      }
    }
  }

  /// The class's sample, new if it was not met yet.
  MaskSample& find(Label label) {
    for (std::size_t k = 0; k < count_; ++k) {
      if (samples_[k].label == label) {
        return samples_[k];
      }
    }
    samples_[count_].label = label;
    return samples_[count_++];
  }

  const MaskSample* begin() const { return samples_.data(); }
  const MaskSample* end() const { return samples_.data() + count_; }

 private:
  std::array<MaskSample, 17> samples_;  // 16 pixels and the reference's class
  std::size_t count_ = 0;
};

struct MaskDifference {
  float energy = 0.0F;
  float force = 0.0F;
  float curvature = 0.0F;
};

MaskDifference compare(Label reference, MaskSamples samples) {
  samples.find(reference);
  MaskDifference difference;
  for (const MaskSample& sample : samples) {
    const float error = sample.value - (sample.label == reference ? 1.0F : 0.0F);
    difference.energy += error * error;
    difference.force += 2.0F * error * sample.slope;
    difference.curvature += 2.0F * sample.slope * sample.slope;
  }
  return difference;
}

void add_pair(const cv::Mat& labels_i,
              const cv::Mat& labels_j,
              const SurfaceWarp& warp,
              PixelForces* forces) {
  cv::Mat force = cv::Mat::zeros(labels_i.size(), CV_32FC1);
  cv::Mat curvature = cv::Mat::zeros(labels_i.size(), CV_32FC1);
  for (int y = 0; y < labels_i.rows; ++y) {
    for (int x = 0; x < labels_i.cols; ++x) {
      const Label reference = labels_i.at<Label>(y, x);
      const std::optional<WarpedPoint> point =
          reference == kUnlabelled ? std::nullopt : warp.at(x, y);
      if (!point) {
        continue;
      }
      const MaskSamples samples(labels_j, *point);
      bool known = true;
      for (const MaskSample& sample : samples) {
        known = known && sample.label != kUnlabelled;
      }
      if (known) {
        const MaskDifference difference = compare(reference, samples);
        forces->energy += difference.energy;
        ++forces->pixels;
        force.at<float>(y, x) = difference.force;
        curvature.at<float>(y, x) = difference.curvature;
      }
    }
  }
  forces->add(force, curvature);
}

}  // namespace

PairwiseSemanticEnergy pairwise_semantic_energy(const TriangleMesh& mesh,
                                                const std::vector<SemanticView>& views,
                                                const std::vector<SurfaceView>& surfaces,
                                                const std::vector<std::vector<int>>& partners,
                                                bool with_gradient) {
  const std::vector<Eigen::Vector3d> normals = facet_normals(mesh);
  const auto compare_masks = [&](std::size_t i, std::size_t j, PixelForces* forces) {
    if (!views[i].segmentation.empty() && !views[j].segmentation.empty()) {
      const SurfaceWarp warp(mesh, normals, views[i].view, surfaces[i], views[j].view, surfaces[j]);
      add_pair(views[i].segmentation, views[j].segmentation, warp, forces);
    }
  };
  return sum_over_pairs<PairwiseSemanticEnergy>(
      mesh, normals, views, surfaces, partners, with_gradient, compare_masks);
}

}  // namespace facet_mapping
