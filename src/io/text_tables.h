// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The text files of KITTI folders: rows of numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problems.h"
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace facet_mapping {

/// The numbers on a line ("nan" is one); nothing if a word is no number.
std::optional<std::vector<double>> parse_numbers(const std::string& text);

/// What is wrong with a row that should hold `columns` finite numbers; empty if nothing is.
std::string row_fault(const std::optional<std::vector<double>>& numbers, std::size_t columns);

/// Rows of `columns` finite numbers; blank lines are skipped. A missing file or a wrong row is
/// added to the problems with its line number (a wrong row still holds its place, filled with
/// zeros).
std::vector<std::vector<double>> read_rows(const std::string& path,
                                           std::size_t columns,
                                           Problems& problems);

/// One 3x4 transform per row. Rows that are not rigid are added to the problems.
std::vector<Eigen::Isometry3d> read_poses(const std::string& path, Problems& problems);

/// One strictly growing time in seconds per row.
std::vector<double> read_times(const std::string& path, Problems& problems);

/// The nearest rigid transform; nothing if the linear part is no rotation to within 1e-3.
std::optional<Eigen::Isometry3d> rigid_from(const Eigen::Matrix3d& linear,
                                            const Eigen::Vector3d& translation);

}  // namespace facet_mapping
