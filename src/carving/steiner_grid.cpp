// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "carving/steiner_grid.h"

#include <algorithm>
#include <cmath>

#include "carving/grid_key.h"

namespace facet_mapping::carving {
namespace {

std::uint64_t mix(std::uint64_t value) {  // the finaliser of splitmix64
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31U);
}

double unit_interval(std::uint64_t hash) {
  return static_cast<double>(hash >> 11U) * 0x1.0p-53;
}

Eigen::Vector3d jitter(std::uint64_t key) {
  return {unit_interval(mix(key ^ 0x9E3779B97F4A7C15ULL)),
          unit_interval(mix(key + 1)),
          unit_interval(mix(key + 0xD1B54A32D192ED03ULL))};
}

}  // namespace

// Jitter keeps the nodes in general position, in which the triangulation and the walk are fastest.
Eigen::Vector3d SteinerGrid::position(std::uint64_t key) const {
  const GridCell corner(grid_coordinate(key, 0), grid_coordinate(key, 1), grid_coordinate(key, 2));
  return spacing_m_ * (corner.cast<double>() + jitter(key));
}

void SteinerGrid::touch(std::uint64_t key, Node* node) {
  if (!node->touched) {
    node->touched = true;
    touched_.push_back(key);
  }
}

void SteinerGrid::count_sensor(const Eigen::Vector3d& center, int change) {
  if (spacing_m_ <= 0.0) {
    return;
  }
  const auto reach = static_cast<std::int64_t>(std::ceil(reach_m_ / spacing_m_));
  const GridCell middle = grid_cell(center, spacing_m_);
  for (std::int64_t x = middle.x() - reach; x <= middle.x() + reach; ++x) {
    for (std::int64_t y = middle.y() - reach; y <= middle.y() + reach; ++y) {
      for (std::int64_t z = middle.z() - reach; z <= middle.z() + reach; ++z) {
        const std::uint64_t key = grid_key({x, y, z});
        if ((position(key) - center).norm() <= reach_m_) {
          Node& node = nodes_[key];
          node.sensors = std::max(0, node.sensors + change);
          touch(key, &node);
        }
      }
    }
  }
}

void SteinerGrid::count_point(const Eigen::Vector3d& point, int change) {
  if (spacing_m_ <= 0.0) {
    return;
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(clearance_m_);
  const GridCell low = grid_cell(point - margin, spacing_m_);
  const GridCell high = grid_cell(point + margin, spacing_m_);
  for (std::int64_t x = low.x(); x <= high.x(); ++x) {
    for (std::int64_t y = low.y(); y <= high.y(); ++y) {
      for (std::int64_t z = low.z(); z <= high.z(); ++z) {
        const std::uint64_t key = grid_key({x, y, z});
        if ((position(key) - point).norm() < clearance_m_) {
          Node& node = nodes_[key];
          node.points = std::max(0, node.points + change);
          touch(key, &node);
        }
      }
    }
  }
}

std::vector<SteinerGrid::Wish> SteinerGrid::take_wishes() {
  std::vector<Wish> wishes;
  std::sort(touched_.begin(), touched_.end());
  for (const std::uint64_t key : touched_) {
    const auto at = nodes_.find(key);
    if (at == nodes_.end()) {
      continue;
    }
    Node& node = at->second;
    node.touched = false;
    const bool wanted = node.sensors > 0 && node.points == 0;
    if (wanted != (node.site != kNoId)) {
      wishes.push_back({key, position(key), node.site});
    } else if (node.sensors == 0 && node.points == 0) {
      nodes_.erase(at);
    }
  }
  touched_.clear();
  return wishes;
}

void SteinerGrid::set_site(std::uint64_t key, SiteId site) {
  Node& node = nodes_[key];
  node.site = site;
  if (site == kNoId && node.sensors == 0 && node.points == 0) {
    nodes_.erase(key);
  }
}

std::vector<SiteId> SteinerGrid::forget_beyond(const Eigen::Vector3d& center, double radius_m) {
  std::vector<SiteId> sites;
  for (auto at = nodes_.begin(); at != nodes_.end();) {
    if ((position(at->first) - center).norm() <= radius_m) {
      ++at;
      continue;
    }
    if (at->second.site != kNoId) {
      sites.push_back(at->second.site);
    }
    at = nodes_.erase(at);
  }
  std::sort(sites.begin(), sites.end());
  return sites;
}

std::size_t SteinerGrid::bytes() const {
  constexpr std::size_t kNode = 48;  // a hash node as the allocator rounds it
  return nodes_.bucket_count() * sizeof(void*) + nodes_.size() * kNode;
}

}  // namespace facet_mapping::carving
