// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the system says of the process's memory.
#pragma once

#include <cstdint>

namespace facet_mapping {

struct ProcessMemory {
  std::uint64_t resident = 0;  ///< bytes in RAM
  std::uint64_t shared = 0;    ///< of those, pages of files: programs and libraries

  std::uint64_t own() const { return resident > shared ? resident - shared : 0; }
};

/// From /proc/self/statm; zeros where there is none.
ProcessMemory process_memory();

}  // namespace facet_mapping
