// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The calibration files of KITTI folders.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "problems.h"
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace facet_mapping {

/// "key: numbers" lines (others, such as "calib_time: 09-Jan-2012", are not kept).
class CalibFile {
 public:
  CalibFile(const std::string& path, Problems& problems);

  bool has(const std::string& key) const { return values_.count(key) > 0; }

  /// The `count` numbers of a key; a missing key or another count is added to the problems.
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t count) const;

  std::optional<Eigen::Matrix3d> matrix3(const std::string& key) const;
  std::optional<Eigen::Matrix<double, 3, 4>> matrix34(const std::string& key) const;
  /// A 3x4 rigid transform.
  std::optional<Eigen::Isometry3d> transform(const std::string& key) const;
  /// A rotation (9 numbers) and a translation (3 numbers) under two keys.
  std::optional<Eigen::Isometry3d> transform(const std::string& rotation,
                                             const std::string& translation) const;

 private:
  std::string path_;
  Problems& problems_;
  bool exists_ = false;
  std::map<std::string, std::vector<double>> values_;
};

}  // namespace facet_mapping
