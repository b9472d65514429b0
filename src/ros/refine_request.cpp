// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/refine_request.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "facet_mapping/ros/mesh_filter.h"

namespace facet_mapping {
namespace {

constexpr int kMaxLevels = 8;
constexpr int kMaxIterations = 1000;

void check_budget(const char* name, double value) {
  if (!std::isfinite(value) || value < 0.0) {
    throw std::invalid_argument(std::string(name) + " must be 0 (no limit) or positive");
  }
}

int count_or_default(const char* name, int value, int fallback, int largest) {
  if (value < 0 || value > largest) {
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                "; allowed are 1 to " + std::to_string(largest) +
                                ", or 0 for the node's parameter");
  }
  return value == 0 ? fallback : value;
}

double weight_or_default(const char* name, double value, double fallback, double largest) {
  if (!std::isfinite(value) || value > largest) {
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                "; allowed are 0 to " + std::to_string(largest) +
                                ", or a negative number for the node's parameter");
  }
  return value < 0.0 ? fallback : value;
}

bool photometric(std::uint8_t asked, bool fallback) {
  using Request = Refine::Request;
  if (asked > Request::OFF) {
    throw std::invalid_argument("photometric must be 0 (default), 1 (on) or 2 (off)");
  }
  return asked == Request::DEFAULT ? fallback : asked == Request::ON;
}

SemanticMode semantic_mode(std::uint8_t asked, SemanticMode fallback) {
  using Request = Refine::Request;
  switch (asked) {
    case Request::SEMANTIC_DEFAULT:
      return fallback;
    case Request::SEMANTIC_OFF:
      return SemanticMode::kOff;
    case Request::SEMANTIC_NORMAL:
      return SemanticMode::kNormal;
    case Request::SEMANTIC_FULL:
      return SemanticMode::kFull;
    case Request::SEMANTIC_PAIRWISE:
      return SemanticMode::kPairwise;
    case Request::SEMANTIC_SPLIT:
      return SemanticMode::kSplit;
    default:
      throw std::invalid_argument(
          "semantic_mode must be 0 (default), 1 (off), 2 (normal), 3 (full), 4 (pairwise) or 5 "
          "(split)");
  }
}

}  // namespace

RefinementConfig refinement_config(const Refine::Request& request,
                                   const RefinementConfig& defaults,
                                   const Eigen::Isometry3d& region_from_map) {
  constexpr double kLargestSemanticWeight = 1e6;
  check_budget("time_budget", request.time_budget);
  check_budget("memory_budget", request.memory_budget);
  RefinementConfig config = defaults;
  config.part = part_of_request(request.region, region_from_map, request.classes);
  config.iterations =
      count_or_default("iterations", request.iterations, defaults.iterations, kMaxIterations);
  config.levels = count_or_default("levels", request.levels, defaults.levels, kMaxLevels);
  config.photometric = photometric(request.photometric, defaults.photometric);
  config.semantic = semantic_mode(request.semantic_mode, defaults.semantic);
  if (request.custom_weights != 0) {
    config.semantic_weight = weight_or_default("semantic_weight",
                                               request.semantic_weight,
                                               defaults.semantic_weight,
                                               kLargestSemanticWeight);
    config.smoothing = weight_or_default("smoothing", request.smoothing, defaults.smoothing, 1.0);
    config.thin_plate =
        weight_or_default("thin_plate", request.thin_plate, defaults.thin_plate, 1.0);
  }
  return config;
}

double estimate_refine_mib(const TriangleMesh& mesh,
                           const std::vector<LabeledView>& views,
                           const RefinementConfig& config) {
  // Measured on KITTI images: per pixel of every view a float image with its gradients, class ids
  // and one rendering (ids, depth), a third more for the pyramid; per facet positions, normals,
  // adjacency and gradients of two meshes.
  constexpr double kBytesPerPixel = 28.0 * 4.0 / 3.0;
  constexpr double kBytesPerPairPixel = 6.0;  // the energies of three shapes
  constexpr double kBytesPerFacet = 600.0;
  double pixels = 0.0;
  double facets = static_cast<double>(mesh.triangles.size());
  for (const LabeledView& view : views) {
    pixels += static_cast<double>(view.gray.total());
  }
  // Subdivision stops where facets cover subdivide_px pixels.
  facets = std::max(facets, pixels / config.subdivide_px);
  const double per_pixel = kBytesPerPixel + kBytesPerPairPixel * config.pairs_per_view;
  return (pixels * per_pixel + facets * kBytesPerFacet) / (1024.0 * 1024.0);
}

}  // namespace facet_mapping
