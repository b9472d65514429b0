// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rows that several nodes' tables share.
#pragma once

#include <limits>

#include "facet_mapping/ros/node_config.h"

namespace facet_mapping {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Limits kPositive{kSmallestPositive, kInfinity};
constexpr Limits kNotNegative{0.0, kInfinity};
constexpr Limits kUnit{0.0, 1.0};

void add_label_file(ParameterTable* table, std::string* value);
void add_segmentation(ParameterTable* table, SegmentationInput* config);
void add_pose(ParameterTable* table, PoseInput* config);
void add_sky(ParameterTable* table, SkyConfig* config);
void add_moving_camera(ParameterTable* table, MovingCameraConfig* config);
void add_output(ParameterTable* table, MeshOutput* config);

}  // namespace facet_mapping
