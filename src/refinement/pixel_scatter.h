// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From pixels to the vertices of the facets that they show.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "facet_mapping/geometry/camera.h"
#include "facet_mapping/geometry/mesh.h"
#include "facet_mapping/refinement/vertex_field.h"
#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {

/// Barycentric weights of the point where the viewing ray (map frame, from `center`) meets the
/// plane of a facet; they sum to 1 and are negative outside the facet.
Eigen::Vector3d barycentric_weights(const TriangleMesh& mesh,
                                    std::size_t facet,
                                    const Eigen::Vector3d& center,
                                    const Eigen::Vector3d& ray);

/// Adds phi_k(x) force(u) n to the gradient and phi_k(x) curvature(u) to the curvature of the
/// facet's vertices k, for every pixel u. Since the weights sum to 1, (sum phi_k v_k)^2 is at most
/// sum phi_k v_k^2, so the curvature stays an upper bound.
void scatter_to_vertices(const TriangleMesh& mesh,
                         const std::vector<Eigen::Vector3d>& normals,
                         const View& view,
                         const FacetImage& image,
                         const cv::Mat& force,
                         const cv::Mat& curvature,
                         VertexField* field);

}  // namespace facet_mapping
