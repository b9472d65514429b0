// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/view_pairs.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "facet_mapping/refinement/visible_point.h"

namespace facet_mapping {
namespace {

constexpr double kDegPerRad = 180.0 / M_PI;

/// A surface point that view i sees.
struct Sample {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
  double footprint;  ///< metres per pixel in view i
};

/// About a thousand samples on a regular grid, whatever the image size.
std::vector<Sample> sample_view(const TriangleMesh& mesh,
                                const View& view,
                                const SurfaceView& surface) {
  constexpr double kSamples = 1000.0;
  const double area = static_cast<double>(view.camera.width) * view.camera.height;
  const int step = std::max(1, static_cast<int>(std::sqrt(area / kSamples)));
  std::vector<Sample> samples;
  for (int y = step / 2; y < view.camera.height; y += step) {
    for (int x = step / 2; x < view.camera.width; x += step) {
      if (surface.usable.at<std::uint8_t>(y, x) == 0) {
        continue;
      }
      const double depth = surface.image.depth.at<float>(y, x);
      const Eigen::Vector3d ray = view.camera.ray({static_cast<double>(x), static_cast<double>(y)});
      const Eigen::Vector3d normal =
          facet_cross(mesh, surface.image.facets.at<int>(y, x)).normalized();
      samples.push_back({view.world_from_cam * (depth * ray), normal, depth / view.camera.fx});
    }
  }
  return samples;
}

/// What `partner` says about the sample, 0 (nothing) .. 1.
double sample_score(const Sample& sample,
                    const Eigen::Vector3d& center,
                    const View& partner,
                    const VisiblePoint& visible,
                    double best_parallax_deg) {
  const std::optional<Eigen::Vector3d> in_partner = visible.in_camera(sample.point);
  if (!in_partner) {
    return 0.0;
  }
  const Eigen::Vector3d d_i = (sample.point - center).normalized();
  const Eigen::Vector3d d_j = (sample.point - partner.center()).normalized();
  const double parallax = kDegPerRad * std::atan2(d_i.cross(d_j).norm(), d_i.dot(d_j));
  const double ratio = sample.footprint / (in_partner->z() / partner.camera.fx);
  const double resolution = std::min(ratio, 1.0 / ratio);
  const double incidence =
      std::min(1.0, std::abs(sample.normal.dot(d_j)) / std::abs(sample.normal.dot(d_i)));
  return parallax_score(parallax, best_parallax_deg) * resolution * incidence;
}

/// scores[j][s]: what view j says about sample s of view i.
using ScoreTable = std::vector<std::vector<double>>;

ScoreTable score_partners(const TriangleMesh& mesh,
                          const std::vector<View>& views,
                          const std::vector<SurfaceView>& surfaces,
                          std::size_t i,
                          double best_parallax_deg) {
  const std::vector<Sample> samples = sample_view(mesh, views[i], surfaces[i]);
  ScoreTable scores(views.size());
  for (std::size_t j = 0; j < views.size(); ++j) {
    if (j == i) {
      continue;
    }
    const VisiblePoint visible(views[j], surfaces[j]);
    for (const Sample& sample : samples) {
      scores[j].push_back(
          sample_score(sample, views[i].center(), views[j], visible, best_parallax_deg));
    }
  }
  return scores;
}

/// Sum over the samples of sqrt(known + new): the root makes a second opinion on a sample worth
/// less than a first one on another.
double joint_score(const std::vector<double>& known, const std::vector<double>& more) {
  double sum = 0.0;
  for (std::size_t s = 0; s < known.size(); ++s) {
    sum += std::sqrt(known[s] + more[s]) - std::sqrt(known[s]);
  }
  return sum;
}

std::vector<int> choose_partners(ScoreTable scores, const ViewPairConfig& config) {
  std::size_t samples = 0;
  for (const std::vector<double>& row : scores) {
    samples = std::max(samples, row.size());
  }
  std::vector<double> known(samples, 0.0);
  std::vector<int> partners;
  while (static_cast<int>(partners.size()) < config.pairs_per_view) {
    int best = -1;
    double best_gain = config.min_shared_fraction * static_cast<double>(samples);
    for (std::size_t j = 0; j < scores.size(); ++j) {
      const double gain = scores[j].empty() ? 0.0 : joint_score(known, scores[j]);
      if (gain > best_gain) {
        best = static_cast<int>(j);
        best_gain = gain;
      }
    }
    if (best < 0) {
      break;
    }
    for (std::size_t s = 0; s < samples; ++s) {
      known[s] += scores[best][s];
    }
    scores[best].clear();
    partners.push_back(best);
  }
  return partners;
}

}  // namespace

double parallax_score(double parallax_deg, double best_parallax_deg) {
  const double root = 2.0 * parallax_deg * best_parallax_deg /
                      (parallax_deg * parallax_deg + best_parallax_deg * best_parallax_deg);
  return root * root;
}

std::vector<std::vector<int>> select_view_pairs(const TriangleMesh& mesh,
                                                const std::vector<View>& views,
                                                const std::vector<SurfaceView>& surfaces,
                                                const ViewPairConfig& config) {
  std::vector<std::vector<int>> partners(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    partners[i] =
        choose_partners(score_partners(mesh, views, surfaces, i, config.best_parallax_deg), config);
  });
  return partners;
}

}  // namespace facet_mapping
