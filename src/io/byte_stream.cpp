// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/io/byte_stream.h"

namespace facet_mapping {

std::uint64_t checksum(const char* data, std::size_t size) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::size_t k = 0; k < size; ++k) {
    hash = (hash ^ static_cast<unsigned char>(data[k])) * 1099511628211ULL;
  }
  return hash;
}

}  // namespace facet_mapping
