// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Paths that users write into service calls and parameters.
#pragma once

#include <string>

namespace facet_mapping {

/// Absolute path of a mesh file: `~` is the home folder, a relative path starts at
/// ROS_HOME (default ~/.ros), `.ply` is added where there is no extension. Throws
/// std::invalid_argument on an empty path, a folder or another extension.
std::string mesh_path(const std::string& path);

/// Absolute path of a folder, by the rules above; "" stays "".
std::string folder_path(const std::string& path);

/// A label file: a path as above, or the bare name of one in the package's config/labels. Throws
/// std::invalid_argument with the names that exist.
std::string label_file_path(const std::string& name_or_path);

}  // namespace facet_mapping
