// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The folder layouts that read_dataset knows.
#pragma once

#include <string>

#include "problems.h"

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {

// Each adds what is wrong to the problems and returns as far as it came.
Dataset read_plain_layout(const std::string& folder, Problems& problems);
Dataset read_kitti_odometry(const std::string& folder, Problems& problems);
Dataset read_kitti_raw(const std::string& folder, Problems& problems);
Dataset read_strecha(const std::string& folder, Problems& problems);
Dataset read_colmap(const std::string& folder, Problems& problems);
Dataset read_mvsnet(const std::string& folder, Problems& problems);
Dataset read_dtu(const std::string& folder, Problems& problems);

// Whether the folder has the layout, where one file's or folder's name does not tell it.
bool is_colmap(const std::string& folder);
bool is_mvsnet(const std::string& folder);
bool is_dtu(const std::string& folder);

}  // namespace facet_mapping
