// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The vertices of a mesh as points with rays: who sees them is found by rendering the mesh.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/points/labeled_point.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

struct SeenPointsConfig {
  double depth_tolerance = 0.005;  ///< rendered depth may differ by this share of the point's
  double sigma_m = 0.0;            ///< handed on with each point, metres
};

class SeenPoints {
 public:
  /// Keeps a reference to the mesh. Throws std::invalid_argument if it has no facets or is invalid.
  SeenPoints(const TriangleMesh& mesh, const SeenPointsConfig& config);

  /// The vertices that the view sees, in its camera's optical frame, in the mesh's order, with the
  /// class of the pixel that they fall on. `labels`: CV_16UC1 of the camera's size, or empty.
  PointFrame seen_from(const View& view, const cv::Mat& labels);

  /// Vertices that no view so far has seen.
  std::size_t unseen() const;

 private:
  const TriangleMesh& mesh_;
  SeenPointsConfig config_;
  std::unique_ptr<FacetRenderer> renderer_;
  std::vector<bool> seen_;
};

/// The typical distance of a vertex to its neighbours, metres: the median length of the edges. By
/// this the lengths of a CarvingConfig can be fitted to a scene. 0 for a mesh without facets.
double median_edge(const TriangleMesh& mesh);

}  // namespace facet_mapping
