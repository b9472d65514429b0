// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How well a reference image and its neighbours agree on each plane.
#pragma once

#include "sweep_image.h"
#include "sweep_planes.h"
#include <opencv2/core.hpp>

namespace facet_mapping::detail {

constexpr int kLargestCost = 96;

/// CV_8UC1, a row per pixel of the small reference (row by row), a column per plane: 0 where the
/// images agree to kLargestCost where they do not or the depth is out of range. The census of a
/// window is compared, with the window as it looks on that plane.
cv::Mat sweep_costs(const SweepImage& reference,
                    const SweepNeighbours& neighbours,
                    const SweepPlanes& planes,
                    const InverseRange& depths);

}  // namespace facet_mapping::detail
