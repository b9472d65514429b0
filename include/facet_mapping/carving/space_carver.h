// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Labelled space carving in a Delaunay triangulation (Romanoni et al. 2017, Sec. 3; algorithm after
// Litvinov & Lhuillier 2014 and Romanoni & Matteucci 2015).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/points/labeled_point.h"

namespace facet_mapping {

/// How cells are called free before the manifold free space grows over them.
enum class Extraction {
  kCount,     ///< free-space evidence above a threshold and above every class's (the paper)
  kGraphCut,  ///< minimum cut between free space and matter with a surface quality term (Labatut
              ///< 2009)
};

struct CarvingConfig {
  Extraction extraction = Extraction::kGraphCut;  ///< how cells are called free
  double surface_quality_weight = 1.0;  ///< graph cut: cost of a badly shaped facet, in rays
  double evidence_cap = 32.0;  ///< graph cut: a cell with more evidence, in rays, of free space or
                               ///< of matter has both scaled down to this
  double neighbour_share = 0.0;  ///< of its neighbours' mean free-space evidence that a cell gets
                                 ///< too (inverse cone, Litvinov & Lhuillier 2014), 0 .. 1
  double free_space_threshold = 1.0;  ///< least free-space evidence of a free cell, in rays
  double behind_distance_m = 0.5;     ///< how far behind a point it is evidence of matter, metres
  double steiner_spacing_m = 6.0;     ///< spacing of the extra vertices that bound cells; 0 = none
  double steiner_reach_m = 52.0;      ///< how far around a sensor extra vertices are laid, metres
  double steiner_clearance_m = 0.5;   ///< extra vertices keep this far from points, metres
  double max_facet_edge_m = 2.5;      ///< facets with a longer edge carry no class, metres
  int min_component_facets = 20;      ///< closed parts of the surface with fewer facets are dropped
  double min_point_spacing_m = 0.05;  ///< a point nearer to a vertex than this joins it, metres
};

/// Throws std::invalid_argument naming the first value out of range.
void validate(const CarvingConfig& config);

/// Of a frame in the map.
using FrameId = std::uint32_t;

/// One frame's points in the map frame, all seen from `center`.
struct CarvingFrame {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  struct Ray {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Label label = kUnlabelled;
    float sigma = 0.0F;  ///< standard deviation along the ray, metres
    bool open =
        false;  ///< the ray only carves: there is no surface at its end (sky, moving things)
  };
  std::vector<Ray> rays;
};

/// The surface between free space and matter. Vertex ids stay the same from one call to the next.
struct CarvedSurface {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex_ids;  ///< one per mesh vertex

  std::size_t bytes() const;  ///< of memory held
};

struct CarvingStats {
  std::size_t vertices = 0;
  std::size_t cells = 0;
  std::size_t rays = 0;
  std::size_t free_cells = 0;     ///< cells that the evidence calls free
  std::size_t reached_cells = 0;  ///< of those, cells inside the manifold free space
};

/// One cell's evidence, keyed by its vertices' coordinates, so that two runs can be compared.
struct CellEvidence {
  std::array<Eigen::Vector3d, 4> vertices;  ///< in lexicographic order
  std::uint32_t free = 0;                   ///< free-space evidence, 1/256 rays
  std::vector<std::pair<Label, std::uint32_t>>
      labels;  ///< class (kUnlabelled: matter without class), 1/256 rays

  bool operator==(const CellEvidence& other) const;
};

class SpaceCarver {
 public:
  explicit SpaceCarver(const CarvingConfig& config);
  ~SpaceCarver();
  SpaceCarver(SpaceCarver&&) noexcept;
  SpaceCarver& operator=(SpaceCarver&&) noexcept;

  /// Takes frames out and puts frames in, in one go. Afterwards every cell's evidence is that of
  /// one batch over all frames that are in, in the order in which they came. Returns the ids of the
  /// added frames (never used twice); ids that are not in the map (any more) are passed over.
  /// Throws std::invalid_argument on coordinates that are not finite; then nothing has changed.
  std::vector<FrameId> update(const std::vector<FrameId>& removed,
                              const std::vector<CarvingFrame>& added);

  std::vector<FrameId> insert(const std::vector<CarvingFrame>& frames) {
    return update({}, frames);
  }
  void remove(const std::vector<FrameId>& ids) { update(ids, {}); }

  /// Drops points outside the ball none of whose rays enters it, with their rays; of more than
  /// `max_points` only the oldest, since each costs about as much as ten insertions. Cells inside
  /// the ball whose vertices all stay keep exactly the evidence that they have; what lies outside
  /// is not kept exact any more.
  void forget_beyond(const Eigen::Vector3d& center,
                     double radius_m,
                     std::size_t max_points = std::numeric_limits<std::size_t>::max());

  /// True while a ray of the frame is in the map.
  bool holds(FrameId id) const;

  /// The manifold surface of the present evidence: always a closed 2-manifold, or empty. Looks only
  /// at what changed since the last call.
  CarvedSurface extract_surface();

  CarvingStats stats() const;

  /// Bytes of memory that the map holds, allocator overhead included.
  std::size_t bytes() const;
  /// Of these, what forgetting has left free for new points.
  std::size_t bytes_unused() const;

  /// The evidence of all finite cells, sorted by their vertices: for tests and inspection.
  std::vector<CellEvidence> evidence() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace facet_mapping
