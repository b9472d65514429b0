// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "centerline.h"

#include <algorithm>
#include <cmath>

namespace facet_mapping {
namespace {

constexpr double kStep = 0.5;     // metres between table entries
constexpr double kBehind = 6.0;   // geometry behind the first camera
constexpr double kBeyond = 30.0;  // table beyond the road's end, for what closes the street
constexpr double kPavementSlope = 0.01;
constexpr double kPi = 3.14159265358979323846;

}  // namespace

Centerline::Centerline(const StreetConfig& config)
    : bend_(config.bend_rad),
      wave_number_(2.0 * kPi / config.bend_period_m),
      crown_(config.crown_m),
      kerb_(config.kerb_height_m),
      origin_height_(0.0),
      begin_(-kBehind),
      end_(config.length_m) {
  const int before = static_cast<int>(kBehind / kStep);
  const int after = static_cast<int>(std::ceil((end_ + kBeyond) / kStep));
  table_.assign(before + after + 1, Eigen::Vector2d::Zero());
  const auto advance = [this](int from, int to) {
    const double middle = begin_ + 0.5 * (from + to) * kStep;
    const Eigen::Vector2d direction(std::cos(heading(middle)), std::sin(heading(middle)));
    table_[to] = table_[from] + (to - from) * kStep * direction;
  };
  for (int k = before; k > 0; --k) {
    advance(k, k - 1);
  }
  for (int k = before; k + 1 < static_cast<int>(table_.size()); ++k) {
    advance(k, k + 1);
  }
  origin_height_ = config.camera_height_m + ground_height(cross_section::kLane);
}

double Centerline::heading(double s) const {
  return bend_ * std::sin(wave_number_ * s);
}

Eigen::Vector2d Centerline::position(double s) const {
  const double index = std::floor((s - begin_) / kStep);
  const auto k =
      static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(table_.size() - 1)));
  const double start = begin_ + static_cast<double>(k) * kStep;
  const double middle = heading(0.5 * (start + s));
  return table_[k] + (s - start) * Eigen::Vector2d(std::cos(middle), std::sin(middle));
}

Eigen::Vector3d Centerline::to_map(double s, double t, double h) const {
  const Eigen::Vector2d middle = position(s);
  const double angle = heading(s);
  return {middle.x() - t * std::sin(angle),
          middle.y() + t * std::cos(angle) - cross_section::kLane,
          h - origin_height_};
}

Eigen::Isometry3d Centerline::frame(double s, double t, double h, double yaw) const {
  Eigen::Isometry3d map_from_local = Eigen::Isometry3d::Identity();
  map_from_local.translation() = to_map(s, t, h);
  map_from_local.linear() =
      Eigen::AngleAxisd(heading(s) + yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return map_from_local;
}

double Centerline::ground_height(double t) const {
  const double distance = std::abs(t);
  const double across = distance / cross_section::kRoadHalfWidth;
  if (across <= 1.0) {
    return -crown_ * across * across;
  }
  return kerb_ - crown_ + kPavementSlope * (distance - cross_section::kRoadHalfWidth);
}

}  // namespace facet_mapping
