// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a ~refine request asks for, checked, and what it will cost.
#pragma once

#include <cstddef>
#include <vector>

#include <facet_mapping/Refine.h>

#include "facet_mapping/refinement/refiner.h"

namespace facet_mapping {

/// The configuration for a request: the node's own where the request says nothing.
/// `region_from_map` leads into the frame of the request's region. Throws std::invalid_argument
/// with a sentence on what is out of range.
RefinementConfig refinement_config(
    const Refine::Request& request,
    const RefinementConfig& defaults,
    const Eigen::Isometry3d& region_from_map = Eigen::Isometry3d::Identity());

/// Estimated peak memory of a refinement beyond what the node holds already, in MiB: images,
/// renderings and gradients of every view on the finest level, and the mesh after subdivision.
double estimate_refine_mib(const TriangleMesh& mesh,
                           const std::vector<LabeledView>& views,
                           const RefinementConfig& config);

}  // namespace facet_mapping
