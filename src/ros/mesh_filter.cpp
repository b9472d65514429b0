// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/mesh_filter.h"

#include <stdexcept>

#include <tf2_eigen/tf2_eigen.h>

namespace facet_mapping {
namespace {

Eigen::Vector3d to_eigen(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}

}  // namespace

bool is_everywhere(const BoxRegion& region) {
  return to_eigen(region.min).isZero(0.0) && to_eigen(region.max).isZero(0.0);
}

void validate(const BoxRegion& region) {
  const Eigen::Vector3d min = to_eigen(region.min);
  const Eigen::Vector3d max = to_eigen(region.max);
  if (!min.allFinite() || !max.allFinite() || (min.array() > max.array()).any()) {
    throw std::invalid_argument(
        "region: every coordinate of min must be finite and at most that of max (metres)");
  }
}

Eigen::AlignedBox3d box_in_map(const BoxRegion& region, const Eigen::Isometry3d& region_from_map) {
  const Eigen::AlignedBox3d box(to_eigen(region.min), to_eigen(region.max));
  const Eigen::Isometry3d map_from_region = region_from_map.inverse(Eigen::Isometry);
  Eigen::AlignedBox3d around;
  for (int corner = 0; corner < 8; ++corner) {
    around.extend(map_from_region *
                  box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  return around;
}

Eigen::Isometry3d lookup_region_from_map(const BoxRegion& region,
                                         const std::string& map_frame,
                                         const tf2_ros::Buffer& buffer) {
  if (is_everywhere(region) || region.frame_id.empty() || region.frame_id == map_frame) {
    return Eigen::Isometry3d::Identity();
  }
  try {
    return tf2::transformToEigen(buffer.lookupTransform(region.frame_id, map_frame, ros::Time(0)));
  } catch (const tf2::TransformException& e) {
    throw std::invalid_argument("region: tf knows no transform from '" + map_frame + "' to '" +
                                region.frame_id + "': " + e.what());
  }
}

MeshPart part_of_request(const BoxRegion& region,
                         const Eigen::Isometry3d& region_from_map,
                         const std::vector<std::uint16_t>& classes) {
  validate(region);
  MeshPart part;
  if (!is_everywhere(region)) {
    part.box = Eigen::AlignedBox3d(to_eigen(region.min), to_eigen(region.max));
    part.box_from_mesh = region_from_map;
  }
  part.classes.assign(classes.begin(), classes.end());
  return part;
}

TriangleMesh filter_mesh(const TriangleMesh& mesh,
                         const BoxRegion& region,
                         const Eigen::Isometry3d& region_from_map,
                         const std::vector<Label>& classes) {
  const std::vector<std::uint8_t> facets =
      facets_of_part(mesh, part_of_request(region, region_from_map, classes));
  return select_facets(mesh, std::vector<bool>(facets.begin(), facets.end()));
}

}  // namespace facet_mapping
