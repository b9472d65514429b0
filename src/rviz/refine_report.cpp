// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/refine_report.h"

#include <cstdio>

namespace facet_mapping {
namespace {

std::string number_text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof(buffer), format, value);
  return buffer;
}

std::string change_text(double before, double after) {
  return number_text("%.4g", before) + " -> " + number_text("%.4g", after);
}

/// 1234567 as "1 234 567".
std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3) {
    text.insert(end - 3, " ");
  }
  return text;
}

}  // namespace

std::string status_word(std::uint8_t code) {
  switch (code) {
    case Status::OK:
      return "OK";
    case Status::INVALID_ARGUMENT:
      return "INVALID_ARGUMENT";
    case Status::NOT_READY:
      return "NOT_READY";
    case Status::CANCELLED:
      return "CANCELLED";
    case Status::BUSY:
      return "BUSY";
    case Status::IO_ERROR:
      return "IO_ERROR";
    case Status::INTERNAL:
      return "INTERNAL";
    default:
      return "code " + std::to_string(code);
  }
}

std::vector<ReportLine> report_lines(const Refine::Response& response, bool dry_run) {
  if (response.facets_before == 0) {
    return {};
  }
  const std::string keyframes = std::to_string(response.views) + " keyframes";
  const std::string memory = number_text("about %.0f MiB", response.peak_memory);
  if (dry_run) {
    return {
        {"Facets", grouped(response.facets_before) + " -> about " + grouped(response.facets_after)},
        {"Photometric", number_text("%.4g", response.before.photometric)},
        {"Semantic", number_text("%.4g", response.before.semantic)},
        {"Time", number_text("about %.1f s", response.seconds) + ", " + keyframes},
        {"Memory", memory}};
  }
  return {{"Facets", grouped(response.facets_before) + " -> " + grouped(response.facets_after)},
          {"Relabelled", grouped(response.relabelled)},
          {"Photometric", change_text(response.before.photometric, response.after.photometric)},
          {"Semantic", change_text(response.before.semantic, response.after.semantic)},
          {"Time", number_text("%.1f s", response.seconds) + ", " + keyframes + ", " + memory}};
}

std::string progress_text(const RefineProgress& progress) {
  return "level " + std::to_string(progress.level) + ", iteration " +
         std::to_string(progress.iteration + 1) + ", " + number_text("%.1f s", progress.seconds) +
         ", " + number_text("%.0f %%", 100.0 * progress.fraction);
}

}  // namespace facet_mapping
