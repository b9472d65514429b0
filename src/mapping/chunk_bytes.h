// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A chunk as bytes and back, bit for bit, for files that the same machine reads.
#pragma once

#include <vector>

#include "facet_mapping/mapping/chunked_mesh.h"

namespace facet_mapping {

/// Appends the chunk, with a checksum, to `bytes`.
void append_chunk(const MeshChunk& chunk, std::vector<char>* bytes);

/// Reads what append_chunk wrote. Throws std::runtime_error if it is damaged.
MeshChunk parse_chunk(const std::vector<char>& bytes);

}  // namespace facet_mapping
