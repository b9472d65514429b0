// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_input.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace facet_mapping {
namespace {

void require(bool condition, const std::string& sentence) {
  if (!condition) {
    throw std::invalid_argument("refine: " + sentence);
  }
}

/// NaN is in no range.
void require_range(double value, double low, double high, const std::string& name) {
  require(value >= low && value <= high,
          name + " is " + std::to_string(value) + "; give a value from " + std::to_string(low) +
              " to " + std::to_string(high));
}

void require_window(int window_px, int largest, const std::string& name) {
  require(window_px >= 3 && window_px <= largest && window_px % 2 == 1,
          name + " is " + std::to_string(window_px) + "; give an odd number from 3 to " +
              std::to_string(largest));
}

void check_view(const LabeledView& view, const std::string& name) {
  const PinholeCamera& camera = view.view.camera;
  require(camera.is_valid(), name + " has an invalid camera");
  require(is_rigid(view.view.world_from_cam), name + " has a pose that is no rigid motion");
  require(view.gray.type() == CV_8UC1 && view.gray.cols == camera.width &&
              view.gray.rows == camera.height,
          name + " needs an 8-bit grey image of its camera's size");
  require(view.labels.empty() ||
              (view.labels.type() == CV_16UC1 && view.labels.size() == view.gray.size()),
          name + " has a segmentation that is not 16-bit or not of the image's size");
}

}  // namespace

void check_config(const RefinementConfig& config) {
  require_range(config.levels, 1, 10, "levels");
  require_range(config.iterations, 0, 1000, "iterations");
  require_range(config.semantic_weight, 0.0, 1e6, "semantic_weight");
  require_range(config.smoothing, 0.0, 1.0, "smoothing");
  require_range(config.thin_plate, 0.0, 1.0, "thin_plate");
  require_range(config.planar_smoothing, 1.0, 1e3, "planar_smoothing");
  require_window(config.ncc_window_px, 31, "ncc_window_px");
  require_window(config.semantic_window_px, 63, "semantic_window_px");
  require_range(config.min_incidence_cos, 0.01, 1.0, "min_incidence_cos");
  require_range(config.pairs_per_view, 1, 1000, "pairs_per_view");
  require_range(config.max_step_edge_fraction, 1e-6, 1.0, "max_step_edge_fraction");
  require_range(config.subdivide_px, 1.0, 1e12, "subdivide_px");
}

void check_views(const std::vector<LabeledView>& views) {
  require(views.size() >= 2,
          std::to_string(views.size()) + " view(s) given; at least two are needed");
  for (std::size_t i = 0; i < views.size(); ++i) {
    check_view(views[i], "view " + std::to_string(i));
  }
}

void check_mesh(const TriangleMesh& mesh, const MeshPart& part) {
  require(!mesh.empty(), "the mesh has no facets");
  require(part.classes.empty() || !mesh.labels.empty(),
          "only some classes shall change, but the mesh has no classes; label it first");
  if (!part.is_everything()) {
    const std::vector<std::uint8_t> inside = facets_of_part(mesh, part);
    require(std::count(inside.begin(), inside.end(), 1) > 0,
            "no facet lies in the region or has one of the classes asked for");
  }
}

void check_part_views(std::size_t seeing, std::size_t views) {
  require(seeing >= 2,
          std::to_string(seeing) + " of the " + std::to_string(views) +
              " views see(s) the part that shall change; at least two are needed");
}

}  // namespace facet_mapping
