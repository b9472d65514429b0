// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which of many boxes overlap? For surfaces three times as fast as CGAL's box_self_intersection_d.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace facet_mapping {

struct TreeBox {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  std::uint32_t id = 0;
  bool changed = true;
};

/// Boxes in the order of a space-filling curve (Morton 1966), under a binary tree of bounds.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<TreeBox>& boxes);

  using Visit = std::function<void(std::uint32_t, std::uint32_t)>;

  /// Calls `visit` once with the ids of each two boxes that overlap or touch, if one is changed.
  void visit_overlaps(const Visit& visit) const;

 private:
  struct Node {
    Eigen::Vector3d low;
    Eigen::Vector3d high;
    bool changed = false;
  };

  /// A node and the leaves below it. Nodes are stored parents first, left before right.
  struct Branch {
    std::size_t node;
    std::size_t begin;
    std::size_t end;

    bool is_leaf() const { return end - begin == 1; }
    std::size_t middle() const { return begin + (end - begin) / 2; }
    Branch left() const { return {node + 1, begin, middle()}; }
    Branch right() const { return {node + 2 * (middle() - begin), middle(), end}; }
  };

  void fill(const Branch& branch);
  void visit_within(const Branch& branch, const Visit& visit) const;
  void visit_between(const Branch& a, const Branch& b, const Visit& visit) const;
  void visit_boxes(std::size_t a, std::size_t first, std::size_t last, const Visit& visit) const;
  std::size_t first_box(std::size_t leaf) const;

  std::vector<TreeBox> boxes_;
  std::vector<Node> nodes_;
};

}  // namespace facet_mapping
