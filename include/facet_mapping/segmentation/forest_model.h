// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A random forest on colour, texture and position of image cells, and its file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {

/// How an image becomes cells and a forest's answer becomes an image again.
struct CellConfig {
  int working_width = 1024;  ///< pixels; images are resized to this width first
  int cell_px = 4;           ///< edge of a cell in the resized image
  bool use_view = false;     ///< features of the pose, too: a GroundView must then be given
};

struct ForestClass {
  Label id = 0;
  std::string name;

  bool operator==(const ForestClass& other) const { return id == other.id && name == other.name; }
};

struct ForestModel {
  struct Node {
    std::int32_t feature = -1;  ///< -1: a leaf
    float threshold = 0.0F;     ///< values up to this go left
    std::int32_t left = 0;      ///< node; of a leaf: its row in `leaves`
    std::int32_t right = 0;     ///< node
  };

  CellConfig cells;
  std::int32_t features = 0;         ///< per cell
  std::vector<ForestClass> classes;  ///< ascending ids
  std::vector<Node> nodes;           ///< children come after their parent
  std::vector<std::int32_t> roots;   ///< node of each tree
  std::vector<std::uint8_t> leaves;  ///< one row per leaf: share of each class, of 255

  /// Row in `leaves` of the leaf that a cell falls into.
  std::size_t leaf(std::int32_t root, const float* cell) const {
    const Node* node = &nodes[root];
    while (node->feature >= 0) {
      node = &nodes[cell[node->feature] <= node->threshold ? node->left : node->right];
    }
    return static_cast<std::size_t>(node->left);
  }

  /// Adds the trees' shares for one cell to `votes` (one per class) and returns their sum.
  float add_votes(const float* cell, float* votes) const;
};

/// One file, little-endian, with a check sum; replaced as a whole. Throws std::runtime_error.
void save_forest(const ForestModel& model, const std::string& path);

/// Throws std::runtime_error on a file that is missing, no forest, of another version or damaged.
ForestModel load_forest(const std::string& path);

}  // namespace facet_mapping
