// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib_file.h"

#include <fstream>
#include <utility>

#include "text_tables.h"

namespace facet_mapping {
namespace {

using RowMatrix34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

}  // namespace

CalibFile::CalibFile(const std::string& path, Problems& problems)
    : path_(path), problems_(problems) {
  std::ifstream input(path);
  exists_ = static_cast<bool>(input);
  if (!exists_) {
    problems.add_missing(path);
  }
  for (std::string line; std::getline(input, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) {
      continue;
    }
    std::optional<std::vector<double>> numbers = parse_numbers(line.substr(colon + 1));
    if (numbers) {
      values_[line.substr(0, colon)] = std::move(*numbers);
    }
  }
}

std::optional<std::vector<double>> CalibFile::numbers(const std::string& key,
                                                      std::size_t count) const {
  const auto found = values_.find(key);
  if (found == values_.end()) {
    if (exists_) {
      problems_.add(path_ + " has no line '" + key + ":' with " + std::to_string(count) +
                    " numbers");
    }
    return std::nullopt;
  }
  const std::string fault = row_fault(found->second, count);
  if (!fault.empty()) {
    problems_.add(path_ + ": '" + key + "' " + fault);
    return std::nullopt;
  }
  return found->second;
}

std::optional<Eigen::Matrix3d> CalibFile::matrix3(const std::string& key) const {
  const auto values = numbers(key, 9);
  if (!values) {
    return std::nullopt;
  }
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values->data());
}

std::optional<Eigen::Matrix<double, 3, 4>> CalibFile::matrix34(const std::string& key) const {
  const auto values = numbers(key, 12);
  if (!values) {
    return std::nullopt;
  }
  return Eigen::Map<const RowMatrix34>(values->data());
}

std::optional<Eigen::Isometry3d> CalibFile::transform(const std::string& key) const {
  const auto matrix = matrix34(key);
  if (!matrix) {
    return std::nullopt;
  }
  auto rigid = rigid_from(matrix->leftCols<3>(), matrix->col(3));
  if (!rigid) {
    problems_.add(path_ + ": '" + key + "' is no rigid transform");
  }
  return rigid;
}

std::optional<Eigen::Isometry3d> CalibFile::transform(const std::string& rotation,
                                                      const std::string& translation) const {
  const auto linear = matrix3(rotation);
  const auto shift = numbers(translation, 3);
  if (!linear || !shift) {
    return std::nullopt;
  }
  auto rigid = rigid_from(*linear, Eigen::Map<const Eigen::Vector3d>(shift->data()));
  if (!rigid) {
    problems_.add(path_ + ": '" + rotation + "' is no rotation");
  }
  return rigid;
}

}  // namespace facet_mapping
