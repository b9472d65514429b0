// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finding the files of each frame in a dataset's folders.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "problems.h"

#include "facet_mapping/io/dataset.h"

namespace facet_mapping {

/// Names without extension of the images in a folder; empty if there is no such folder.
std::set<std::string> image_names(const std::string& folder);

/// Names without extension of the images of `count` frames. Missing numbers and images without a
/// frame are added to the problems; `counted_by` names the file that says how many frames there
/// are.
std::vector<std::string> frame_names(const std::string& image_folder,
                                     std::size_t count,
                                     const std::string& counted_by,
                                     Problems& problems);

/// Where the files of a kind lie; empty where the dataset has no such folder.
struct FrameFolders {
  std::string left;
  std::string right;
  std::string labels;
  std::string gt_labels;
  std::string gt_depth;
  std::string scans;
};

/// Fills the paths of all frames, has_right and has_scans. A right folder must hold every frame;
/// what it lacks is added to the problems.
void find_files(const FrameFolders& folders,
                const std::vector<std::string>& names,
                Dataset& dataset,
                Problems& problems);

/// folder/name with the first of the usual image extensions that exists; empty if none does.
std::string find_image(const std::string& folder, const std::string& name);

/// The first of these folders below `parent` that exists, else empty.
std::string first_folder(const std::string& parent, const std::vector<std::string>& names);

}  // namespace facet_mapping
