// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include "building_style.h"
#include "scene_parts.h"

namespace facet_mapping {
namespace {

using Corners = std::array<Eigen::Vector3d, 4>;

constexpr double kReveal = 0.18;      // depth of a window in its wall
constexpr double kOverhang = 0.40;    // roof before the facade
constexpr double kBelowGround = 0.3;  // walls start this much below the pavement

/// A facade: a wall cut by grid lines, some of whose cells are openings.
class Facade {
 public:
  Facade(SceneBuilder* builder, const BuildingStyle& style, double width)
      : builder_(builder), style_(style), x_{0.0}, z_{-kBelowGround, 0.0} {
    const double bay = width / style.bays;
    for (int b = 0; b < style.bays; ++b) {
      x_.push_back((b + 0.5) * bay - 0.5 * style.window_width);
      x_.push_back((b + 0.5) * bay + 0.5 * style.window_width);
    }
    x_.push_back(width);
    for (int f = 0; f < style.floors; ++f) {
      z_.push_back(f * style.floor_height + style.sill_height);
      z_.push_back(z_.back() + style.window_height);
    }
    z_.push_back(style.floors * style.floor_height + 0.3);
  }

  double height() const { return z_.back(); }

  void add() {
    for (int i = 0; i + 1 < static_cast<int>(x_.size()); ++i) {
      for (int k = 0; k + 1 < static_cast<int>(z_.size()); ++k) {
        add_cell(i, k);
      }
    }
  }

 private:
  bool is_door(int i, int k) const { return i == 2 * style_.door_bay + 1 && (k == 1 || k == 2); }
  bool is_opening(int i, int k) const {
    return is_door(i, k) || (i % 2 == 1 && k >= 2 && k % 2 == 0);
  }

  Eigen::Vector3d corner(int i, double y, int k) const { return {x_[i], y, z_[k]}; }

  void add_cell(int i, int k) {
    if (!is_opening(i, k)) {
      builder_->add_flat(
          {corner(i, 0, k), corner(i + 1, 0, k), corner(i + 1, 0, k + 1), corner(i, 0, k + 1)},
          style_.wall);
      return;
    }
    add_pane(i, k);
    add_reveals(i, k);
    if (!is_door(i, k)) {
      builder_->add_box(
          {x_[i] - 0.08, -0.12, z_[k] - 0.07}, {x_[i + 1] + 0.08, 0.0, z_[k]}, style_.trim, "Y");
    }
  }

  void add_pane(int i, int k) {
    const bool door = is_door(i, k);
    const int bottom = door ? 1 : k;
    const auto vertex = [&](int di, int dk) {
      const Eigen::Vector3d p = corner(i + di, kReveal, k + dk);
      return SceneVertex{
          p, Eigen::Vector3d(p.x() - x_[i], p.z() - z_[bottom], i + 64.0 * k).cast<float>()};
    };
    builder_->add_quad({vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1)},
                       door ? style_.door : style_.window);
  }

  void add_reveals(int i, int k) {
    const auto reveal = [&](int i0, int k0, int i1, int k1) {
      builder_->add_flat(
          {corner(i0, 0, k0), corner(i0, kReveal, k0), corner(i1, kReveal, k1), corner(i1, 0, k1)},
          style_.wall);
    };
    if (!is_opening(i - 1, k)) {
      reveal(i, k, i, k + 1);
    }
    if (!is_opening(i + 1, k)) {
      reveal(i + 1, k + 1, i + 1, k);
    }
    if (!is_opening(i, k - 1)) {
      reveal(i + 1, k, i, k);
    }
    if (!is_opening(i, k + 1)) {
      reveal(i, k + 1, i + 1, k + 1);
    }
  }

  SceneBuilder* builder_;
  const BuildingStyle& style_;
  std::vector<double> x_;
  std::vector<double> z_;
};

void add_side_walls(SceneBuilder* builder,
                    const BuildingStyle& style,
                    const Eigen::Vector3d& size) {
  const double w = size.x();
  const double d = size.y();
  const double h = size.z();
  const double low = -kBelowGround;
  builder->add_flat({Eigen::Vector3d(0, d, low), {0, 0, low}, {0, 0, h}, {0, d, h}}, style.wall);
  builder->add_flat({Eigen::Vector3d(w, 0, low), {w, d, low}, {w, d, h}, {w, 0, h}}, style.wall);
  builder->add_flat({Eigen::Vector3d(w, d, low), {0, d, low}, {0, d, h}, {w, d, h}}, style.wall);
}

/// Gable triangles; the ridge runs along the facade.
void add_gable(SceneBuilder* builder,
               const BuildingStyle& style,
               const Eigen::Vector3d& size,
               double x) {
  const auto vertex = [&](double y, double z) {
    return builder->add_vertex({Eigen::Vector3d(x, y, z), Eigen::Vector3d(y, z, x).cast<float>()});
  };
  const std::uint32_t front = vertex(0.0, size.z());
  const std::uint32_t back = vertex(size.y(), size.z());
  const std::uint32_t ridge = vertex(0.5 * size.y(), size.z() + 0.4 * size.y());
  if (x > 0.0) {
    builder->add_triangle(front, back, ridge, style.wall);
  } else {
    builder->add_triangle(back, front, ridge, style.wall);
  }
}

void add_pitched_roof(SceneBuilder* builder,
                      const BuildingStyle& style,
                      const Eigen::Vector3d& size) {
  const double slope = 0.8;  // rise over run: 0.4 of the depth over half of it
  const double w = size.x();
  const double ridge_y = 0.5 * size.y();
  const double ridge_z = size.z() + slope * ridge_y;
  const double eave_z = size.z() - slope * kOverhang;
  const double length = std::hypot(ridge_y + kOverhang, ridge_z - eave_z);
  const auto slope_quad = [&](double eave_y, double x0, double x1) {
    const auto vertex = [&](double x, bool up) {
      return SceneVertex{Eigen::Vector3d(x, up ? ridge_y : eave_y, up ? ridge_z : eave_z),
                         Eigen::Vector3d(x, up ? length : 0.0, 0.0).cast<float>()};
    };
    builder->add_quad({vertex(x0, false), vertex(x1, false), vertex(x1, true), vertex(x0, true)},
                      style.roof);
  };
  slope_quad(-kOverhang, -0.1, w + 0.1);
  slope_quad(size.y() + kOverhang, w + 0.1, -0.1);
  const Corners soffit{Eigen::Vector3d(-0.1, 0.0, eave_z),
                       {w + 0.1, 0.0, eave_z},
                       {w + 0.1, -kOverhang, eave_z},
                       {-0.1, -kOverhang, eave_z}};
  builder->add_flat(soffit, style.trim);
  add_gable(builder, style, size, 0.0);
  add_gable(builder, style, size, w);
}

void add_flat_roof(SceneBuilder* builder, const BuildingStyle& style, const Eigen::Vector3d& size) {
  builder->add_box(
      {-0.05, -0.22, size.z() - 0.25}, {size.x() + 0.05, 0.0, size.z() + 0.35}, style.trim, "");
  builder->add_flat({Eigen::Vector3d(0, 0, size.z()),
                     {size.x(), 0, size.z()},
                     {size.x(), size.y(), size.z()},
                     {0, size.y(), size.z()}},
                    style.trim);
}

}  // namespace

void add_building(const Scene& scene,
                  const Eigen::Isometry3d& map_from_local,
                  double width,
                  double depth,
                  Random* random) {
  SceneBuilder* builder = scene.builder;
  const BuildingStyle style = draw_building_style(builder, width, random);
  builder->begin_part(map_from_local);
  Facade facade(builder, style, width);
  facade.add();
  const Eigen::Vector3d size(width, depth, facade.height());
  add_side_walls(builder, style, size);
  if (style.ledge) {
    const double z = style.floor_height;
    builder->add_box({0.0, -0.10, z - 0.08}, {width, 0.0, z + 0.12}, style.trim, "Y");
  }
  if (style.pitched) {
    add_pitched_roof(builder, style, size);
  } else {
    add_flat_roof(builder, style, size);
  }
}

}  // namespace facet_mapping
