// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The size of an image without decoding it.
#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace facet_mapping {

/// Width and height in pixels, as stored (no turning by EXIF). PNG and JPEG tell it in their header
/// (PNG specification 11.2.2, ITU-T T.81 B.2.2); everything else is decoded. Throws
/// std::runtime_error on a missing or damaged file.
cv::Size read_image_size(const std::string& path);

}  // namespace facet_mapping
