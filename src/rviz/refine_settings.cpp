// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/refine_settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace facet_mapping {
namespace {

constexpr double kMargin = 0.001;            // metres
constexpr std::size_t kMaxNamesToTell = 12;  // in a message

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Nothing unless the whole text is a number.
template <typename Number>
std::optional<Number> to_number(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end ? std::optional<Number>(number) : std::nullopt;
}

int count_of(const char* name, const std::string& text) {
  const std::string digits = trimmed(text);
  if (digits.empty()) {
    return 0;
  }
  const std::optional<int> count = to_number<int>(digits);
  if (!count || *count < 1) {
    throw std::invalid_argument(std::string(name) + ": '" + digits +
                                "' is no whole number above 0; leave it empty for the node's "
                                "parameter");
  }
  return *count;
}

/// `if_empty` where nothing was typed.
double amount_of(const char* name, const std::string& text, double if_empty) {
  const std::string digits = trimmed(text);
  if (digits.empty()) {
    return if_empty;
  }
  const std::optional<double> amount = to_number<double>(digits);
  if (!amount || !std::isfinite(*amount) || *amount < 0.0) {
    throw std::invalid_argument(std::string(name) + ": '" + digits +
                                "' is no number from 0 (such as 0.5)");
  }
  return *amount;
}

std::string names_of(const std::vector<ClassStyle>& known) {
  std::string names;
  for (std::size_t k = 0; k < known.size() && k < kMaxNamesToTell; ++k) {
    names += (k == 0 ? "" : ", ") + known[k].name;
  }
  return names + (known.size() > kMaxNamesToTell ? ", ..." : "");
}

std::uint16_t class_id(const std::string& word, const std::vector<ClassStyle>& known) {
  const auto it = std::find_if(
      known.begin(), known.end(), [&](const ClassStyle& style) { return style.name == word; });
  if (it != known.end()) {
    return it->id;
  }
  if (const std::optional<std::uint16_t> id = to_number<std::uint16_t>(word)) {
    return *id;
  }
  throw std::invalid_argument("Classes: there is no class '" + word + "'" +
                              (known.empty() ? "; without a shown mesh give ids"
                                             : "; there are " + names_of(known) + ", and ids"));
}

void set_weights(const RefineSettings& settings, Refine::Request* request) {
  constexpr double kNodeParameter = -1.0;
  request->semantic_weight = amount_of("Sem. weight", settings.semantic_weight, kNodeParameter);
  request->smoothing = amount_of("Smoothing", settings.smoothing, kNodeParameter);
  request->thin_plate = amount_of("Thin plate", settings.thin_plate, kNodeParameter);
  const bool is_any_set =
      request->semantic_weight >= 0.0 || request->smoothing >= 0.0 || request->thin_plate >= 0.0;
  request->custom_weights = is_any_set ? 1 : 0;
}

}  // namespace

std::vector<std::uint16_t> parse_classes(const std::string& text,
                                         const std::vector<ClassStyle>& known) {
  std::vector<std::uint16_t> ids;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    word = trimmed(word);
    if (word.empty()) {
      continue;
    }
    const std::uint16_t id = class_id(word, known);
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) {
      ids.push_back(id);
    }
  }
  return ids;
}

BoxRegion region_around(const Eigen::AlignedBox3d& box, const std::string& frame_id) {
  BoxRegion region;
  region.frame_id = frame_id;
  region.min.x = box.min().x() - kMargin;
  region.min.y = box.min().y() - kMargin;
  region.min.z = box.min().z() - kMargin;
  region.max.x = box.max().x() + kMargin;
  region.max.y = box.max().y() + kMargin;
  region.max.z = box.max().z() + kMargin;
  return region;
}

Refine::Request refine_request(const RefineSettings& settings,
                               const std::vector<ClassStyle>& known_classes,
                               const std::optional<BoxRegion>& region) {
  Refine::Request request;
  request.start = settings.start;
  if (settings.visible_region) {
    if (!region) {
      throw std::invalid_argument("the view shows nothing of a mesh, so nothing was asked for");
    }
    request.region = *region;
  }
  request.classes = parse_classes(settings.classes, known_classes);
  request.levels = count_of("Levels", settings.levels);
  request.iterations = count_of("Iterations", settings.iterations);
  request.photometric = settings.photometric;
  request.semantic_mode = settings.semantic_mode;
  set_weights(settings, &request);
  request.time_budget = amount_of("Budget", settings.time_budget, 0.0);
  return request;
}

}  // namespace facet_mapping
