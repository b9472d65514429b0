// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_tables.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "facet_mapping/geometry/camera.h"

namespace facet_mapping {
namespace {

using RowMatrix34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

std::string path_and_line(const std::string& path, int line) {
  return path + " line " + std::to_string(line);
}

struct Row {
  int line = 0;
  std::vector<double> numbers;  // empty if the row is wrong
};

std::vector<Row> read_numbered_rows(const std::string& path,
                                    std::size_t columns,
                                    Problems& problems) {
  std::vector<Row> rows;
  std::ifstream input(path);
  if (!input) {
    problems.add_missing(path);
    return rows;
  }
  int line = 0;
  for (std::string text; std::getline(input, text);) {
    ++line;
    if (text.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    const std::optional<std::vector<double>> numbers = parse_numbers(text);
    const std::string fault = row_fault(numbers, columns);
    if (!fault.empty()) {
      problems.add(path_and_line(path, line) + " " + fault);
    }
    rows.push_back({line, fault.empty() ? *numbers : std::vector<double>()});
  }
  if (rows.empty()) {
    problems.add(path + " is empty");
  }
  return rows;
}

}  // namespace

std::optional<std::vector<double>> parse_numbers(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (end != word.c_str() + word.size()) {
      return std::nullopt;
    }
  }
  return numbers;
}

std::string row_fault(const std::optional<std::vector<double>>& numbers, std::size_t columns) {
  if (!numbers) {
    return "holds a word that is no number";
  }
  if (numbers->size() != columns) {
    return "holds " + std::to_string(numbers->size()) + " numbers instead of " +
           std::to_string(columns);
  }
  for (const double number : *numbers) {
    if (!std::isfinite(number)) {
      return "holds NaN or infinity";
    }
  }
  return "";
}

std::vector<std::vector<double>> read_rows(const std::string& path,
                                           std::size_t columns,
                                           Problems& problems) {
  std::vector<std::vector<double>> values;
  for (Row& row : read_numbered_rows(path, columns, problems)) {
    row.numbers.resize(columns, 0.0);
    values.push_back(std::move(row.numbers));
  }
  return values;
}

std::vector<Eigen::Isometry3d> read_poses(const std::string& path, Problems& problems) {
  std::vector<Eigen::Isometry3d> poses;
  for (const Row& row : read_numbered_rows(path, 12, problems)) {
    std::optional<Eigen::Isometry3d> pose;
    if (!row.numbers.empty()) {
      const Eigen::Map<const RowMatrix34> matrix(row.numbers.data());
      pose = rigid_from(matrix.leftCols<3>(), matrix.col(3));
      if (!pose) {
        problems.add(path_and_line(path, row.line) +
                     " is no rigid transform (its 3x3 part is no rotation)");
      }
    }
    poses.push_back(pose.value_or(Eigen::Isometry3d::Identity()));
  }
  return poses;
}

std::vector<double> read_times(const std::string& path, Problems& problems) {
  std::vector<double> times;
  for (const Row& row : read_numbered_rows(path, 1, problems)) {
    const double time = row.numbers.empty() ? NAN : row.numbers.front();
    if (!times.empty() && time <= times.back()) {
      problems.add(path_and_line(path, row.line) + " is not later than the line above");
    }
    times.push_back(time);
  }
  return times;
}

std::optional<Eigen::Isometry3d> rigid_from(const Eigen::Matrix3d& linear,
                                            const Eigen::Vector3d& translation) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = linear;
  transform.translation() = translation;
  if (!is_rigid(transform)) {
    return std::nullopt;
  }
  // The text has few digits: a rotation made exactly orthonormal inverts exactly.
  transform.linear() = Eigen::Quaterniond(linear).normalized().toRotationMatrix();
  return transform;
}

}  // namespace facet_mapping
