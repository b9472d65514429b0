// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/facet_info.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace facet_mapping {
namespace {

constexpr const char* kNotKnown = "not known";
constexpr double kRadToDeg = 180.0 / 3.14159265358979323846;
constexpr int kMostViews = 255;  // that a facet's byte on the graphics card can tell

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const double rounded = std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;  // no -0
  std::snprintf(text.data(), text.size(), "%.*f", decimals, rounded);
  return text.data();
}

std::string tuple(const Eigen::Vector3d& v) {
  return "(" + fixed(v.x(), 2) + ", " + fixed(v.y(), 2) + ", " + fixed(v.z(), 2) + ")";
}

}  // namespace

Eigen::Vector3d cross_of(const FacetInfo& facet) {
  return (facet.corners[1] - facet.corners[0]).cross(facet.corners[2] - facet.corners[0]);
}

std::optional<double> slope_deg(const FacetInfo& facet) {
  if (facet.normal.isZero()) {
    return std::nullopt;
  }
  return kRadToDeg * std::acos(std::clamp(facet.normal.normalized().z(), -1.0, 1.0));
}

std::string class_text(const FacetInfo& facet) {
  return facet.class_id == kUnlabelled
             ? facet.class_name
             : facet.class_name + " (" + std::to_string(facet.class_id) + ")";
}

std::string confidence_text(const FacetInfo& facet) {
  return facet.confidence ? fixed(*facet.confidence, 2) : kNotKnown;
}

std::string normal_text(const FacetInfo& facet) {
  return facet.normal.isZero() ? "none (no area)" : tuple(facet.normal);
}

std::string slope_text(const FacetInfo& facet) {
  const std::optional<double> slope = slope_deg(facet);
  return slope ? fixed(*slope, 1) + " deg" : "none (no area)";
}

std::string area_text(const FacetInfo& facet) {
  return facet.area_m2 < 0.01 ? fixed(1.0e4 * facet.area_m2, 2) + " cm^2"
                              : fixed(facet.area_m2, 4) + " m^2";
}

std::string views_text(const FacetInfo& facet) {
  if (!facet.views) {
    return kNotKnown;
  }
  return std::to_string(*facet.views) + (*facet.views == kMostViews ? " or more" : "");
}

std::string chunk_text(const FacetInfo& facet) {
  return "(" + std::to_string(facet.chunk[0]) + ", " + std::to_string(facet.chunk[1]) + ", " +
         std::to_string(facet.chunk[2]) + ")";
}

std::string position_text(const FacetInfo& facet) {
  return tuple(facet.position) + " m in " + facet.frame_id;
}

std::string describe(const FacetInfo& facet) {
  return class_text(facet) + ", confidence " + confidence_text(facet) + ", normal " +
         normal_text(facet) + ", slope " + slope_text(facet) + ", area " + area_text(facet) +
         ", views " + views_text(facet) + ", chunk " + chunk_text(facet) + ", at " +
         position_text(facet);
}

}  // namespace facet_mapping
