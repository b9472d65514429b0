// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of images in sentences for people.
#pragma once

#include <string>

namespace facet_mapping {

/// "1242x375".
inline std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// The same of anything with a width and a height: cv::Size, PinholeCamera.
template <typename Sized>
std::string size_text(const Sized& sized) {
  return size_text(sized.width, sized.height);
}

}  // namespace facet_mapping
