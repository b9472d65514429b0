// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Turns exact labels into what a small segmentation network would give.
#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

namespace facet_mapping {

/// The errors of a network: borders are displaced and rounded off, thin things break or vanish, and
/// blobs of a class turn into one that networks confuse it with (building and vegetation; road,
/// pavement and terrain; poles and their background ...).
///
/// `exact`: CV_8UC1 Cityscapes train ids, 255 = void (kept as it is). `level`: 0 gives the exact
/// labels, 1 is about as wrong as a small network trained on other streets, larger is worse.
/// Lengths scale with the image's width. Same seed, same result; different seeds are independent.
/// Throws std::invalid_argument for another type, an empty image or a negative level.
cv::Mat noisy_segmentation(const cv::Mat& exact, double level, std::uint64_t seed);

}  // namespace facet_mapping
