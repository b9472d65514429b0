// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What there is to say of one facet.
#pragma once

#include <array>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "facet_mapping/geometry/label.h"
#include "facet_mapping/mapping/chunked_mesh.h"

namespace facet_mapping {

struct FacetInfo {
  std::string class_name;
  Label class_id = kUnlabelled;
  std::optional<double> confidence;  ///< 0..1
  std::optional<int> views;          ///< images that see it; 255: or more
  ChunkKey chunk{};
  std::string frame_id;                                ///< of the mesh
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< where it was met, metres, frame_id
  double distance = 0.0;                               ///< from the eye, metres
  std::array<Eigen::Vector3d, 3> corners{};            ///< metres, frame_id
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< to free space, fixed frame; or zero
  double area_m2 = 0.0;
};

/// (b - a) x (c - a) of the corners, in frame_id: points to free space.
Eigen::Vector3d cross_of(const FacetInfo& facet);

/// Between the normal and z of the fixed frame: 0 is a floor, 90 a wall, 180 a ceiling. Nothing for
/// a facet without area. Degrees.
std::optional<double> slope_deg(const FacetInfo& facet);

/// The values as the inspector shows them; "not known" where the mesh does not say.
std::string class_text(const FacetInfo& facet);
std::string confidence_text(const FacetInfo& facet);
std::string normal_text(const FacetInfo& facet);
std::string slope_text(const FacetInfo& facet);
std::string area_text(const FacetInfo& facet);
std::string views_text(const FacetInfo& facet);
std::string chunk_text(const FacetInfo& facet);
std::string position_text(const FacetInfo& facet);
/// All of it in one line.
std::string describe(const FacetInfo& facet);

}  // namespace facet_mapping
