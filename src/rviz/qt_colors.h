// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>

#include "facet_mapping/rviz/class_table.h"

namespace facet_mapping {

inline QColor to_qt(const Rgb& color) {
  return {color[0], color[1], color[2]};
}

inline Rgb from_qt(const QColor& color) {
  return {static_cast<std::uint8_t>(color.red()),
          static_cast<std::uint8_t>(color.green()),
          static_cast<std::uint8_t>(color.blue())};
}

}  // namespace facet_mapping
