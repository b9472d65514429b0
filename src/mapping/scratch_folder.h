// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Folders that belong to a running process.
#pragma once

#include <string>

namespace facet_mapping {

/// A new folder in `parent`, held by a lock for as long as `*lock` (a descriptor) is open.
/// Throws std::runtime_error with path and reason.
std::string make_scratch_folder(const std::string& parent, int* lock);

/// Removes the folders in `parent` that make_scratch_folder made and nobody holds any more: those
/// of killed processes.
void remove_abandoned_folders(const std::string& parent);

/// Closes the lock and removes the folder.
void remove_scratch_folder(const std::string& folder, int* lock);

}  // namespace facet_mapping
