// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Frame and class list of a mesh as PLY comments:
//   comment frame_id FRAME
//   comment class ID RED GREEN BLUE FLAGS NAME      (FLAGS: dynamic,ignore,planar,sky or none)
//   comment class_alias ID RED GREEN BLUE
// Control characters, '%' and outer spaces of names are written as %XX.
#pragma once

#include <string>
#include <vector>

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping::ply {

struct Description {
  std::string frame_id;
  LabelSet labels;
};

/// Comments without the word "comment".
std::vector<std::string> write_comments(const Description& description);

/// Other comments are skipped. Throws std::runtime_error on a class that cannot be read.
Description read_comments(const std::vector<std::string>& comments);

}  // namespace facet_mapping::ply
