// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scores per class, as a network has them: the blurred indicator of the displaced truth, plus what
// smooth random fields shift from a class to those it is confused with. The highest score wins.
#include "facet_mapping/synthetic/segmentation_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "random.h"
#include <opencv2/imgproc.hpp>

#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {
namespace {

using namespace street_class;

constexpr double kFullWidth = 1242.0;  // lengths below are pixels of an image of this width
constexpr double kShift = 2.5;         // standard deviation of a border's place at level 1
constexpr double kShiftCell = 18.0;    // distance over which borders move together
constexpr double kBlur = 2.5;          // standard deviation of the scores' blur at level 1
constexpr double kBlobCell = 55.0;     // size of the blobs of wrong classes
constexpr int kMargin = 4;             // cells of a noise grid around the image

/// A share of `from` may turn into `to`.
struct Confusion {
  Label from;
  Label to;
  float strength;
};

constexpr std::array<Confusion, 20> kConfusions{{{kRoad, kSidewalk, 0.50F},
                                                 {kSidewalk, kRoad, 0.75F},
                                                 {kSidewalk, kTerrain, 0.60F},
                                                 {kTerrain, kSidewalk, 0.75F},
                                                 {kTerrain, kVegetation, 0.75F},
                                                 {kVegetation, kTerrain, 0.40F},
                                                 {kVegetation, kBuilding, 0.60F},
                                                 {kBuilding, kVegetation, 0.60F},
                                                 {kBuilding, kSky, 0.30F},
                                                 {kSky, kBuilding, 0.35F},
                                                 {kSky, kVegetation, 0.35F},
                                                 {kPole, kBuilding, 0.80F},
                                                 {kPole, kVegetation, 0.80F},
                                                 {kTrafficSign, kBuilding, 0.70F},
                                                 {kTrafficSign, kPole, 0.60F},
                                                 {kBuilding, kTrafficSign, 0.35F},
                                                 {kCar, kBuilding, 0.45F},
                                                 {kCar, kRoad, 0.30F},
                                                 {kRoad, kCar, 0.25F},
                                                 {kBuilding, kCar, 0.25F}}};

/// A smooth random field of zero mean and about unit deviation, correlated over `cell` pixels.
cv::Mat smooth_field(const cv::Size& size, double cell, std::uint64_t seed) {
  Random random(seed);
  const int columns = static_cast<int>(std::ceil(size.width / cell)) + 2 * kMargin;
  const int rows = static_cast<int>(std::ceil(size.height / cell)) + 2 * kMargin;
  cv::Mat grid(rows, columns, CV_32FC1);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      grid.at<float>(r, c) = static_cast<float>(random.normal());
    }
  }
  // Cubic interpolation keeps about 0.7 of the deviation.
  const cv::Matx23d grid_from_image(1.0 / cell, 0.0, kMargin, 0.0, 1.0 / cell, kMargin);
  cv::Mat field;
  cv::warpAffine(grid, field, grid_from_image, size, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
  return field * (1.0 / 0.7);
}

/// The labels with every pixel fetched from a little away.
cv::Mat displaced(const cv::Mat& labels, double scale, double level, std::uint64_t seed) {
  const double amount = kShift * scale * level;
  const cv::Mat across = smooth_field(labels.size(), kShiftCell * scale, derive_seed(seed, 1));
  const cv::Mat down = smooth_field(labels.size(), kShiftCell * scale, derive_seed(seed, 2));
  cv::Mat result(labels.size(), CV_8UC1);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const auto from_x = std::lround(x + amount * across.at<float>(y, x));
      const auto from_y = std::lround(y + amount * down.at<float>(y, x));
      result.at<std::uint8_t>(y, x) =
          labels.at<std::uint8_t>(static_cast<int>(std::clamp(from_y, 0L, labels.rows - 1L)),
                                  static_cast<int>(std::clamp(from_x, 0L, labels.cols - 1L)));
    }
  }
  return result;
}

using Scores = std::map<Label, cv::Mat>;

/// The blurred indicator of every class that occurs.
Scores indicators(const cv::Mat& labels, double sigma) {
  Scores scores;
  for (int id = 0; id < 255; ++id) {
    cv::Mat mask = labels == id;
    if (cv::countNonZero(mask) == 0) {
      continue;
    }
    cv::Mat score;
    mask.convertTo(score, CV_32FC1, 1.0 / 255.0);
    if (sigma > 0.1) {
      cv::GaussianBlur(score, score, {}, sigma, sigma, cv::BORDER_REPLICATE);
    }
    scores[static_cast<Label>(id)] = score;
  }
  return scores;
}

/// Adds to each class what the random fields take from those that are confused with it.
Scores confused(const Scores& clean, double scale, double level, std::uint64_t seed) {
  Scores scores;
  for (const auto& [id, score] : clean) {
    scores[id] = score.clone();
  }
  for (std::size_t k = 0; k < kConfusions.size(); ++k) {
    const Confusion& confusion = kConfusions[k];
    const auto from = clean.find(confusion.from);
    if (from == clean.end()) {
      continue;
    }
    const cv::Size size = from->second.size();
    const cv::Mat coarse = smooth_field(size, kBlobCell * scale, derive_seed(seed, 100 + k));
    const cv::Mat fine = smooth_field(size, 0.3 * kBlobCell * scale, derive_seed(seed, 200 + k));
    const cv::Mat field = cv::max(coarse + 0.5 * fine, 0.0);
    cv::Mat& to = scores[confusion.to];
    if (to.empty()) {
      to = cv::Mat::zeros(size, CV_32FC1);
    }
    to += level * confusion.strength * from->second.mul(field);
  }
  return scores;
}

cv::Mat winners(const Scores& scores, const cv::Mat& exact) {
  cv::Mat labels(exact.size(), CV_8UC1, cv::Scalar(255));
  cv::Mat best = cv::Mat::zeros(exact.size(), CV_32FC1);
  for (const auto& [id, score] : scores) {
    const cv::Mat wins = score > best;
    labels.setTo(cv::Scalar(id), wins);
    score.copyTo(best, wins);
  }
  labels.setTo(cv::Scalar(255), exact == 255);
  return labels;
}

}  // namespace

cv::Mat noisy_segmentation(const cv::Mat& exact, double level, std::uint64_t seed) {
  if (exact.empty() || exact.type() != CV_8UC1) {
    throw std::invalid_argument("segmentation noise: give a CV_8UC1 image of class ids");
  }
  if (!(level >= 0.0 && level <= 100.0)) {
    throw std::invalid_argument("segmentation noise: level is " + std::to_string(level) +
                                ", give 0 (exact) to 100");
  }
  if (level == 0.0) {
    return exact.clone();
  }
  const double scale = exact.cols / kFullWidth;
  const cv::Mat moved = displaced(exact, scale, level, seed);
  const Scores clean = indicators(moved, kBlur * scale * level);
  return winners(confused(clean, scale, level, seed), exact);
}

}  // namespace facet_mapping
