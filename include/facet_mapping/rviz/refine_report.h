// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The answers of a refine node as text for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <facet_mapping/Refine.h>
#include <facet_mapping/RefineProgress.h>

namespace facet_mapping {

/// "OK", "BUSY", ... as in Status.msg.
std::string status_word(std::uint8_t code);

struct ReportLine {
  std::string what;
  std::string value;
};

/// What a refinement has changed and cost; empty if none took place.
std::vector<ReportLine> report_lines(const Refine::Response& response, bool dry_run);

/// "level 1, iteration 3, 12.5 s, 40 %"; iterations count from 1, as the parameter does.
std::string progress_text(const RefineProgress& progress);

}  // namespace facet_mapping
