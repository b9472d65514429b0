// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "street_shading.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "noise.h"
#include "random.h"

namespace facet_mapping {
namespace {

constexpr int kCurveSteps = 4096;

/// Grey level of a linear value in [0, 1]: the usual display gamma.
const std::array<float, kCurveSteps + 1>& response_curve() {
  static const std::array<float, kCurveSteps + 1> kCurve = [] {
    std::array<float, kCurveSteps + 1> curve{};
    for (int k = 0; k <= kCurveSteps; ++k) {
      curve[k] = 255.0F * std::pow(static_cast<float>(k) / kCurveSteps, 1.0F / 2.2F);
    }
    return curve;
  }();
  return kCurve;
}

float respond(float linear) {
  const float index = std::clamp(linear, 0.0F, 1.0F) * kCurveSteps;
  const int k = std::min(static_cast<int>(index), kCurveSteps - 1);
  const auto& curve = response_curve();
  return curve[k] + (index - static_cast<float>(k)) * (curve[k + 1] - curve[k]);
}

/// About standard normal, from the sixteen-bit quarters of one word.
float rough_normal(std::uint64_t bits) {
  float sum = 0.0F;
  for (unsigned k = 0; k < 4; ++k) {
    sum += static_cast<float>((bits >> (16U * k)) & 0xFFFFU);
  }
  return (sum * 0x1.0p-16F - 2.0F) * 1.7320508F;
}

}  // namespace

Eigen::Vector3f sky_color(const Eigen::Vector3f& direction) {
  const float up = std::clamp(direction.z(), 0.0F, 1.0F);
  const Eigen::Vector3f horizon(0.80F, 0.86F, 0.92F);
  const Eigen::Vector3f zenith(0.22F, 0.42F, 0.80F);
  const Eigen::Vector3f clear = blend(horizon, zenith, std::sqrt(up));
  const Eigen::Vector3f at_clouds = direction / (up + 0.15F);
  const float cloud = octave_noise(at_clouds, 0.7F, 4, 0.01F, 77U);
  const float cover = std::clamp(0.25F + 0.8F * cloud, 0.0F, 0.8F);
  return blend(clear, Eigen::Vector3f(0.92F, 0.93F, 0.94F), cover);
}

Eigen::Vector3f irradiance(const Eigen::Vector3f& normal, float sun_cosine, float sunlit) {
  const Eigen::Vector3f sun(1.30F, 1.22F, 1.08F);
  const Eigen::Vector3f sky(0.42F, 0.47F, 0.56F);
  const Eigen::Vector3f ground(0.26F, 0.25F, 0.23F);
  const float up = 0.5F + 0.5F * normal.z();
  return blend(ground, sky, up) + sun_cosine * sunlit * sun;
}

cv::Mat develop(const cv::Mat& linear, const SensorNoise& noise) {
  cv::Mat image(linear.size(), CV_8UC3);
  const auto gain = static_cast<float>(noise.gain);
  const auto sigma = static_cast<float>(noise.sigma_grey);
  std::uint64_t counter = noise.seed;
  for (int y = 0; y < linear.rows; ++y) {
    const auto* from = linear.ptr<cv::Vec3f>(y);
    auto* to = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < linear.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        counter += 0x9E3779B97F4A7C15ULL;
        const float grey = respond(gain * from[x][2 - c]) + sigma * rough_normal(mix_bits(counter));
        to[x][c] = cv::saturate_cast<std::uint8_t>(grey);
      }
    }
  }
  return image;
}

}  // namespace facet_mapping
