// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// sensor_msgs/PointCloud2 and labelled points.
#pragma once

#include <string>
#include <vector>

#include <sensor_msgs/PointCloud2.h>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/labels/label_set.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

/// Reads x y z (float32 or float64, metres) and, where present, `label` (any number type; what is
/// no id 0..65535 becomes kUnlabelled) and `sigma` (metres). Points that are not finite are kept:
/// the map counts them. Throws std::invalid_argument with a sentence if x, y or z is missing or the
/// buffer does not fit its description.
std::vector<LabeledPoint> points_from_cloud(const sensor_msgs::PointCloud2& cloud);

/// One value per point of a field of any number type. Throws std::invalid_argument with a sentence
/// if there is no such field or the buffer does not fit its description.
std::vector<double> values_from_cloud(const sensor_msgs::PointCloud2& cloud,
                                      const std::string& field);

/// True if the cloud says of its points what they are.
bool has_label_field(const sensor_msgs::PointCloud2& cloud);

/// x y z float32, label uint16, sigma float32, in the sensor's frame.
sensor_msgs::PointCloud2 cloud_from_points(const std::vector<LabeledPoint>& points,
                                           const std_msgs::Header& header);

/// One point per facet (its centroid) with x y z, label uint16 and rgb: the mesh for displays and
/// programs that know clouds only.
sensor_msgs::PointCloud2 cloud_from_mesh(const TriangleMesh& mesh,
                                         const LabelSet& labels,
                                         const std_msgs::Header& header);

}  // namespace facet_mapping
