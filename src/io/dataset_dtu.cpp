// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// DTU as published (Jensen et al. 2014): rect_001_max.png ... and pos_001.txt ...
#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "dataset_layouts.h"
#include "dataset_views.h"
#include "projection_matrix.h"
#include "text_tables.h"

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 2> kLights{"_max", "_3_r5000"};
const std::string kPrefix = "rect_";

// "001" of rect_001<light>.
std::string position_of(const std::string& name, const std::string& light) {
  const std::size_t ends = kPrefix.size() + light.size();
  if (name.size() <= ends || name.compare(0, kPrefix.size(), kPrefix) != 0 ||
      name.compare(name.size() - light.size(), light.size(), light) != 0) {
    return "";
  }
  const std::string position = name.substr(kPrefix.size(), name.size() - ends);
  const bool is_number = position.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? position : std::string();
}

std::set<std::string> positions(const std::set<std::string>& names, const std::string& light) {
  std::set<std::string> found;
  for (const std::string& name : names) {
    found.insert(position_of(name, light));
  }
  found.erase("");
  return found;
}

// Images of one light: views under different lights could not be compared.
struct Scan {
  std::string folder;
  std::string light;
  std::set<std::string> positions;
};

Scan find_scan(const std::string& folder) {
  Scan best;
  for (const char* place : {"", "/images", "/image"}) {
    const std::set<std::string> names = image_names(folder + place);
    for (const char* light : kLights) {
      Scan scan{folder + place, light, positions(names, light)};
      if (scan.positions.size() > best.positions.size()) {
        best = std::move(scan);
      }
    }
  }
  return best;
}

bool holds_calibration(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename().string().rfind("pos_", 0) == 0 &&
        entry.path().extension() == ".txt") {
      return true;
    }
  }
  return false;
}

// All scans of a download share one calibration: Calibration/cal18 beside Rectified/scan1.
std::string calibration_folder(const std::string& folder) {
  std::error_code error;
  const fs::path scan = fs::weakly_canonical(folder, error);
  for (const fs::path& parent : {scan, scan.parent_path(), scan.parent_path().parent_path()}) {
    for (const char* name : {"cal18", "calib", "Calibration/cal18", "Calibration"}) {
      if (holds_calibration(parent / name)) {
        return (parent / name).string();
      }
    }
  }
  return holds_calibration(scan) ? scan.string() : std::string();
}

View read_view(const std::string& path, Problems& problems) {
  View view;
  const auto rows = read_rows(path, 4, problems);
  if (rows.size() != 3) {
    if (!rows.empty()) {
      problems.add(path + " holds " + std::to_string(rows.size()) +
                   " rows instead of the 3 of a projection matrix");
    }
    return view;
  }
  Eigen::Matrix<double, 3, 4> projection;
  for (int row = 0; row < 3; ++row) {
    projection.row(row) =
        Eigen::Map<const Eigen::RowVector4d>(rows[static_cast<std::size_t>(row)].data());
  }
  const auto parts = decompose_projection(projection);
  if (!parts) {
    problems.add(path + " is no projection matrix (its left 3x3 part is singular)");
    return view;
  }
  view.camera = camera_from_matrix(parts->intrinsics, path, problems);
  view.world_from_cam = parts->cam_from_world.inverse(Eigen::Isometry);
  return view;
}

DatasetFrame make_frame(const Scan& scan,
                        const std::string& position,
                        const std::string& calibration,
                        const FrameFolders& others,
                        Problems& problems) {
  const std::string name = kPrefix + position + scan.light;
  const std::string path = (fs::path(calibration) / ("pos_" + position + ".txt")).string();
  DatasetFrame frame;
  frame.view = read_view(path, problems);
  frame.left_image = find_image(scan.folder, name);
  find_view_files(others, name, frame);
  set_size_of_image(path, frame, problems);
  return frame;
}

// An image under another light alone would be left out in silence.
void check_complete(const Scan& scan, Problems& problems) {
  for (const char* light : kLights) {
    for (const std::string& position : positions(image_names(scan.folder), light)) {
      if (scan.positions.count(position) == 0) {
        const fs::path path = fs::path(scan.folder) / (kPrefix + position + scan.light);
        problems.add_missing(path.string() + ".png (all views are taken under the same light)");
      }
    }
  }
}

}  // namespace

bool is_dtu(const std::string& folder) {
  return !find_scan(folder).positions.empty();
}

Dataset read_dtu(const std::string& folder, Problems& problems) {
  Dataset dataset;
  const Scan scan = find_scan(folder);
  check_complete(scan, problems);
  const std::string calibration = calibration_folder(folder);
  if (calibration.empty()) {
    problems.add_missing(folder +
                         "/cal18/pos_001.txt ... (projection matrices; also looked for in calib/ "
                         "and Calibration/cal18/, here and in the two folders above)");
    return dataset;
  }
  const FrameFolders others = view_folders(folder);
  dataset.depth_scale = read_depth_scale(others, 0.0, problems);
  for (const std::string& position : scan.positions) {
    dataset.frames.push_back(make_frame(scan, position, calibration, others, problems));
    dataset.frames.back().stamp = static_cast<double>(dataset.frames.size() - 1);
  }
  return dataset;
}

}  // namespace facet_mapping
