// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/vertex_packing.h"

#include <algorithm>
#include <cmath>

namespace facet_mapping {
namespace {

constexpr double kMaxSteps = 32767.0;  // to either side of the centre
constexpr float kOctahedral = 127.0F;  // 0..254 stand for -1..1

/// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors".
std::int16_t pack_normal(const std::array<std::int8_t, 4>& normal) {
  const float x = normal[0];
  const float y = normal[1];
  const float sum = std::abs(x) + std::abs(y) + std::abs(static_cast<float>(normal[2]));
  if (sum == 0.0F) {
    return pack_normal({0, 0, 127, 0});  // no area, hence never seen
  }
  float u = x / sum;
  float v = y / sum;
  if (normal[2] < 0) {
    const float folded = (1.0F - std::abs(v)) * (u < 0.0F ? -1.0F : 1.0F);
    v = (1.0F - std::abs(u)) * (v < 0.0F ? -1.0F : 1.0F);
    u = folded;
  }
  const auto low = static_cast<int>(std::lround(kOctahedral * (u + 1.0F)));
  const auto high = static_cast<int>(std::lround(kOctahedral * (v + 1.0F)));
  return static_cast<std::int16_t>(low + 256 * (high - 128));
}

std::array<std::int8_t, 4> unpack_normal(std::int16_t packed) {
  const float high = std::floor(static_cast<float>(packed) / 256.0F);
  const float low = static_cast<float>(packed) - 256.0F * high;
  float u = low / kOctahedral - 1.0F;
  float v = (high + 128.0F) / kOctahedral - 1.0F;
  const float z = 1.0F - std::abs(u) - std::abs(v);
  if (z < 0.0F) {
    const float unfolded = (1.0F - std::abs(v)) * (u < 0.0F ? -1.0F : 1.0F);
    v = (1.0F - std::abs(u)) * (v < 0.0F ? -1.0F : 1.0F);
    u = unfolded;
  }
  const Eigen::Vector3f unit = Eigen::Vector3f(u, v, z).normalized();
  std::array<std::int8_t, 4> normal{};
  for (int axis = 0; axis < 3; ++axis) {
    normal[static_cast<std::size_t>(axis)] =
        static_cast<std::int8_t>(std::lround(127.0F * unit[axis]));
  }
  return normal;
}

}  // namespace

VertexPacking::VertexPacking(const Eigen::Vector3d& origin, const Eigen::AlignedBox3f& box)
    : origin_(origin), center_(origin) {
  if (box.isEmpty()) {
    return;
  }
  // One step is kept free at either side, since the centre is rounded, too.
  while (static_cast<double>(box.sizes().maxCoeff()) > 2.0 * (kMaxSteps - 1.0) * step_m_) {
    step_m_ *= 2.0;
  }
  const Eigen::Vector3d middle = origin + box.center().cast<double>();
  center_ = step_m_ * (middle / step_m_).array().round().matrix();
}

PackedVertex VertexPacking::pack(const FacetVertex& vertex) const {
  PackedVertex packed;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const double place = origin_[axis] + static_cast<double>(vertex.position[k]);
    const double steps = std::round(place / step_m_) - std::round(center_[axis] / step_m_);
    packed.position[k] = static_cast<std::int16_t>(std::clamp(steps, -kMaxSteps, kMaxSteps));
  }
  packed.normal = pack_normal(vertex.normal);
  packed.facet = vertex.facet;
  return packed;
}

FacetVertex VertexPacking::unpack(const PackedVertex& packed) const {
  FacetVertex vertex;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    vertex.position[k] =
        static_cast<float>(center_[axis] - origin_[axis] + step_m_ * packed.position[k]);
  }
  vertex.normal = unpack_normal(packed.normal);
  vertex.facet = packed.facet;
  return vertex;
}

}  // namespace facet_mapping
