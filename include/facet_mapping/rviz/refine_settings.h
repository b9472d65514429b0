// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From what stands in the fields of the panel Refine to the request of ~refine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <facet_mapping/BoxRegion.h>
#include <facet_mapping/Refine.h>

#include "facet_mapping/rviz/class_table.h"

namespace facet_mapping {

/// Numbers stay the text that was typed; an empty one means the node's parameter, so that no
/// default stands twice.
struct RefineSettings {
  bool visible_region = false;  ///< only what the view shows, not all
  std::string classes;          ///< names or ids between commas; empty: all
  std::uint8_t start = Refine::Request::START_MAP;
  std::uint8_t photometric = Refine::Request::DEFAULT;
  std::uint8_t semantic_mode = Refine::Request::SEMANTIC_DEFAULT;
  std::string levels;
  std::string iterations;
  std::string semantic_weight;
  std::string smoothing;
  std::string thin_plate;
  std::string time_budget;  ///< [s]; empty: no limit
};

/// Ids of the classes in a list such as "road, 8, unlabelled", each once. Throws
/// std::invalid_argument with the names that there are if one is not among them.
std::vector<std::uint16_t> parse_classes(const std::string& text,
                                         const std::vector<ClassStyle>& known);

/// A millimetre wider than the box on each side, so that rounding leaves out no facet. The box must
/// not be empty.
BoxRegion region_around(const Eigen::AlignedBox3d& box, const std::string& frame_id);

/// `region`: needed if settings.visible_region. Throws std::invalid_argument with a sentence if a
/// field does not hold what it should, or if there is no region.
Refine::Request refine_request(const RefineSettings& settings,
                               const std::vector<ClassStyle>& known_classes,
                               const std::optional<BoxRegion>& region);

}  // namespace facet_mapping
