// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the layouts with single images, each with its own camera, have in common.
#pragma once

#include <string>

#include "dataset_files.h"
#include "problems.h"

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {

/// Beside the images: segmentation/ or labels/, labels_gt/ or gt_label(s)/, depth_gt/ or gt_depth/.
FrameFolders view_folders(const std::string& folder);

/// Fills labels and ground truth of one view; `name` has no extension.
void find_view_files(const FrameFolders& folders, const std::string& name, DatasetFrame& frame);

/// The units of the depth images per unit of the poses: the number in scale.txt among them, else
/// `otherwise`; if that is 0, a folder of depth images without scale.txt is a problem.
double read_depth_scale(const FrameFolders& folders, double otherwise, Problems& problems);

/// A camera without size from its matrix. Problems: no focal length, a last row other than 0 0 1,
/// more skew than the digits of a text file make (the camera stays empty).
PinholeCamera camera_from_matrix(const Eigen::Matrix3d& intrinsics,
                                 const std::string& source,
                                 Problems& problems);

/// Gives the camera the size of the frame's image, for files that do not tell the size. Problems: a
/// broken image, a principal point far from the image's centre (the file speaks of another size).
void set_size_of_image(const std::string& source, DatasetFrame& frame, Problems& problems);

}  // namespace facet_mapping
