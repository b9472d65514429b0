// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_tree.h"

#include <algorithm>
#include <utility>

namespace facet_mapping {
namespace {

constexpr std::size_t kLeafSize = 4;

template <typename A, typename B>
bool overlap(const A& a, const B& b) {
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
         b.low[1] <= a.high[1] && a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

/// Puts two zeros behind each of the lower 21 bits.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32U) & 0x1F00000000FFFFU;
  x = (x | x << 16U) & 0x1F0000FF0000FFU;
  x = (x | x << 8U) & 0x100F00F00F00F00FU;
  x = (x | x << 4U) & 0x10C30C30C30C30C3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

std::vector<TreeBox> along_curve(const std::vector<TreeBox>& boxes) {
  constexpr double kCells = 2097151.0;  // per axis: 21 bits
  Eigen::Vector3d low = boxes.front().low;
  Eigen::Vector3d high = boxes.front().high;
  for (const TreeBox& box : boxes) {
    low = low.cwiseMin(box.low);
    high = high.cwiseMax(box.high);
  }
  const double extent = (high - low).maxCoeff();
  const double scale = extent > 0.0 ? kCells / extent : 0.0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(boxes.size());
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    const Eigen::Vector3d at = scale * (0.5 * (boxes[k].low + boxes[k].high) - low);
    keys.emplace_back(spread_bits(static_cast<std::uint64_t>(at.x())) |
                          spread_bits(static_cast<std::uint64_t>(at.y())) << 1U |
                          spread_bits(static_cast<std::uint64_t>(at.z())) << 2U,
                      k);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<TreeBox> sorted;
  sorted.reserve(boxes.size());
  for (const auto& [key, k] : keys) {
    sorted.push_back(boxes[k]);
  }
  return sorted;
}

}  // namespace

BoxTree::BoxTree(const std::vector<TreeBox>& boxes) {
  if (!boxes.empty()) {
    boxes_ = along_curve(boxes);
    const std::size_t leaves = (boxes_.size() + kLeafSize - 1) / kLeafSize;
    nodes_.resize(2 * leaves - 1);
    fill({0, 0, leaves});
  }
}

std::size_t BoxTree::first_box(std::size_t leaf) const {
  return std::min(leaf * kLeafSize, boxes_.size());
}

void BoxTree::fill(const Branch& branch) {
  Node& node = nodes_[branch.node];
  const auto add = [&node](const auto& part) {
    node.low = node.low.cwiseMin(part.low);
    node.high = node.high.cwiseMax(part.high);
    node.changed = node.changed || part.changed;
  };
  const TreeBox& first = boxes_[first_box(branch.begin)];
  node = {first.low, first.high, first.changed};
  if (branch.is_leaf()) {
    for (std::size_t k = first_box(branch.begin); k < first_box(branch.end); ++k) {
      add(boxes_[k]);
    }
    return;
  }
  for (const Branch& child : {branch.left(), branch.right()}) {
    fill(child);
    add(nodes_[child.node]);
  }
}

void BoxTree::visit_overlaps(const Visit& visit) const {
  if (!boxes_.empty()) {
    visit_within({0, 0, (nodes_.size() + 1) / 2}, visit);
  }
}

void BoxTree::visit_boxes(std::size_t a,
                          std::size_t first,
                          std::size_t last,
                          const Visit& visit) const {
  const TreeBox& box = boxes_[a];
  for (std::size_t b = first; b < last; ++b) {
    if ((box.changed || boxes_[b].changed) && overlap(box, boxes_[b])) {
      visit(box.id, boxes_[b].id);
    }
  }
}

void BoxTree::visit_within(const Branch& branch, const Visit& visit) const {
  if (!nodes_[branch.node].changed) {
    return;
  }
  if (branch.is_leaf()) {
    const std::size_t end = first_box(branch.end);
    for (std::size_t a = first_box(branch.begin); a < end; ++a) {
      visit_boxes(a, a + 1, end, visit);
    }
    return;
  }
  visit_within(branch.left(), visit);
  visit_within(branch.right(), visit);
  visit_between(branch.left(), branch.right(), visit);
}

void BoxTree::visit_between(const Branch& a, const Branch& b, const Visit& visit) const {
  const Node& at_a = nodes_[a.node];
  const Node& at_b = nodes_[b.node];
  if (!(at_a.changed || at_b.changed) || !overlap(at_a, at_b)) {
    return;
  }
  if (a.is_leaf() && b.is_leaf()) {
    for (std::size_t k = first_box(a.begin); k < first_box(a.end); ++k) {
      visit_boxes(k, first_box(b.begin), first_box(b.end), visit);
    }
  } else if (a.end - a.begin >= b.end - b.begin) {
    visit_between(a.left(), b, visit);
    visit_between(a.right(), b, visit);
  } else {
    visit_between(a, b.left(), visit);
    visit_between(a, b.right(), visit);
  }
}

}  // namespace facet_mapping
