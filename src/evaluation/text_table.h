// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Text in columns.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace facet_mapping {

/// snprintf of one number.
std::string format_number(const char* pattern, double value);

/// 1234567 -> 1,234,567
std::string grouped_digits(std::size_t number);

/// Rows of cells in columns, the first one left-aligned; a row of one cell is a heading, which
/// takes no part in the widths.
std::string aligned_rows(const std::vector<std::vector<std::string>>& rows);

}  // namespace facet_mapping
