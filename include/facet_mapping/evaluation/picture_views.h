// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cameras to look at a mesh from where no camera was.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/io/dataset.h"

namespace facet_mapping {

/// A camera of this size and horizontal field of view whose optical axis goes from `eye` to
/// `target`, with `up` upwards in the image. Throws std::invalid_argument if eye and target
/// (nearly) coincide, the line between them is parallel to `up`, or size or field of view make no
/// camera.
View look_at(const Eigen::Vector3d& eye,
             const Eigen::Vector3d& target,
             const Eigen::Vector3d& up,
             const cv::Size& size,
             double fov_deg);

/// A camera above and behind the trajectory that looks along it. The height above the first camera
/// grows with the length of the trajectory. Throws std::invalid_argument if the dataset has no
/// frames.
View bird_view(const Dataset& dataset, const cv::Size& size, double fov_deg);

}  // namespace facet_mapping
