// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Adds parts, surfaces and materials to a street.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "facet_mapping/synthetic/street.h"

namespace facet_mapping {

struct SceneVertex {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in the builder's frame
  Eigen::Vector3f texture = Eigen::Vector3f::Zero();
};

/// What a run of facets is.
struct Surface {
  Label label = kUnlabelled;
  std::uint16_t material = 0;
};

/// Corners in counter-clockwise order seen from outside.
using Quad = std::array<SceneVertex, 4>;

class SceneBuilder {
 public:
  explicit SceneBuilder(Street* street) : street_(street) {}

  std::uint16_t add_material(const Material& material);

  /// Ends the part before. Vertices are given in the local frame from now on.
  void begin_part(const Eigen::Isometry3d& map_from_local = Eigen::Isometry3d::Identity());
  /// Ends the last part; the street is complete then.
  void finish();

  std::uint32_t add_vertex(const SceneVertex& vertex);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Surface& surface);

  /// A smooth surface over (rows + 1) x (columns + 1) vertices; its outside is where the step from
  /// row to row crossed with the step from column to column points. `keep` may leave cells out.
  using GridVertex = std::function<SceneVertex(int row, int column)>;
  using GridCell = std::function<bool(int row, int column)>;
  void add_grid(int rows,
                int columns,
                const GridVertex& vertex,
                const Surface& surface,
                const GridCell& keep = {});

  /// A flat surface with its own vertices, so that its edges are hard.
  void add_quad(const Quad& quad, const Surface& surface);
  /// A quad whose texture coordinates are the local position, the facing axis last.
  void add_flat(const std::array<Eigen::Vector3d, 4>& corners, const Surface& surface);
  /// An axis-aligned box of the local frame without the faces named in `without` (of "xXyYzZ",
  /// small letters for the lower ends).
  void add_box(const Eigen::Vector3d& low,
               const Eigen::Vector3d& high,
               const Surface& surface,
               const char* without = "");
  /// A fan over a ring of vertices given counter-clockwise seen from outside.
  void add_fan(const std::vector<SceneVertex>& ring, const Surface& surface);

 private:
  void end_part();
  void set_normals(const StreetPart& part);

  Street* street_;
  Eigen::Isometry3d map_from_local_ = Eigen::Isometry3d::Identity();
};

/// A closed or open tube along z of the local frame: radius and centre per ring.
struct TubeRing {
  Eigen::Vector3d center;
  double radius;
};
void add_tube(SceneBuilder* builder,
              const std::vector<TubeRing>& rings,
              int sides,
              const Surface& surface);

}  // namespace facet_mapping
