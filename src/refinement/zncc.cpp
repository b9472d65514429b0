// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/refinement/zncc.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace facet_mapping {
namespace {

cv::Mat box(const cv::Mat& image, int window_px, bool mean) {
  cv::Mat result;
  cv::boxFilter(image,
                result,
                CV_32F,
                cv::Size(window_px, window_px),
                cv::Point(-1, -1),
                mean,
                cv::BORDER_CONSTANT);
  return result;
}

/// What one window contributes: see the derivation in algorithms section 3.
struct WindowTerms {
  float energy;
  float alpha;      ///< factor of -(I - mI) in the derivative
  float beta;       ///< factor of +(J - mJ) in the derivative
  float curvature;  ///< factor of the squared change
};

WindowTerms window_terms(double var_i, double var_j, double covariance, double n, double noise4) {
  constexpr double kTiny = 1e-6;
  const double vi = std::max(var_i, kTiny);
  const double vj = std::max(var_j, kTiny);
  const double product = vi * vj;
  const double correlation = std::clamp(covariance / std::sqrt(product), -1.0, 1.0);
  const double denominator = product + noise4;
  const double reliability = product / denominator;
  const double reliability_slope = vi * noise4 / (denominator * denominator);
  WindowTerms terms{};
  terms.energy = static_cast<float>(reliability * (1.0 - correlation));
  terms.alpha = static_cast<float>(reliability / std::sqrt(product) / n);
  terms.beta = static_cast<float>(
      (reliability * correlation / vj + 2.0 * (1.0 - correlation) * reliability_slope) / n);
  terms.curvature = static_cast<float>(reliability / vj / n);
  return terms;
}

/// Per-window factors as images, zero where the window does not count.
struct TermImages {
  cv::Mat alpha;
  cv::Mat alpha_mean_i;
  cv::Mat beta;
  cv::Mat beta_mean_j;
  cv::Mat curvature;

  explicit TermImages(const cv::Size& size) {
    for (cv::Mat* image : {&alpha, &alpha_mean_i, &beta, &beta_mean_j, &curvature}) {
      *image = cv::Mat::zeros(size, CV_32F);
    }
  }

  void set(int y, int x, const WindowTerms& terms, float mean_i, float mean_j) {
    alpha.at<float>(y, x) = terms.alpha;
    alpha_mean_i.at<float>(y, x) = terms.alpha * mean_i;
    beta.at<float>(y, x) = terms.beta;
    beta_mean_j.at<float>(y, x) = terms.beta * mean_j;
    curvature.at<float>(y, x) = terms.curvature;
  }
};

/// dE/dJ(w) = -I(w) B(alpha) + B(alpha mI) + J(w) B(beta) - B(beta mJ), B = box sum.
void spread(const TermImages& terms,
            const cv::Mat& image,
            const cv::Mat& warped,
            int window_px,
            ZnccResult* result) {
  result->derivative =
      box(terms.alpha_mean_i, window_px, false) - image.mul(box(terms.alpha, window_px, false)) +
      warped.mul(box(terms.beta, window_px, false)) - box(terms.beta_mean_j, window_px, false);
  result->curvature = box(terms.curvature, window_px, false);
}

}  // namespace

WindowStats window_stats(const cv::Mat& image, int window_px) {
  WindowStats stats;
  stats.mean = box(image, window_px, true);
  stats.variance = box(image.mul(image), window_px, true) - stats.mean.mul(stats.mean);
  return stats;
}

ZnccResult zncc_energy(const cv::Mat& image,
                       const WindowStats& stats,
                       const cv::Mat& warped,
                       const cv::Mat& valid,
                       const ZnccConfig& config,
                       bool with_derivative) {
  const int window_px = config.window_px;
  const double n = static_cast<double>(window_px) * window_px;
  const double noise4 = std::pow(config.noise_gray, 4);
  const WindowStats other = window_stats(warped, window_px);
  const cv::Mat product = box(image.mul(warped), window_px, true);
  const cv::Mat inside = box(valid != 0, window_px, false);
  TermImages terms(with_derivative ? image.size() : cv::Size());
  ZnccResult result;
  result.map = cv::Mat(image.size(), CV_16UC1, cv::Scalar(kNotCounted));
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (inside.at<float>(y, x) < 255.0 * n - 0.5) {
        continue;
      }
      const float mean_i = stats.mean.at<float>(y, x);
      const float mean_j = other.mean.at<float>(y, x);
      const WindowTerms window = window_terms(stats.variance.at<float>(y, x),
                                              other.variance.at<float>(y, x),
                                              product.at<float>(y, x) - mean_i * mean_j,
                                              n,
                                              noise4);
      result.energy += window.energy;
      result.map.at<std::uint16_t>(y, x) =
          static_cast<std::uint16_t>(std::lround(kEnergyUnits * window.energy));
      ++result.pixels;
      if (with_derivative) {
        terms.set(y, x, window, mean_i, mean_j);
      }
    }
  }
  if (with_derivative) {
    spread(terms, image, warped, window_px, &result);
  }
  return result;
}

}  // namespace facet_mapping
