// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The class list: id, name, colour and flags, read from one YAML file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping {

using Rgb = std::array<std::uint8_t, 3>;

struct ClassInfo {
  Label id = 0;
  std::string name;
  Rgb color{};
  bool dynamic = false;      ///< moves on its own (cars, persons)
  bool ignore = false;       ///< never evidence (void, ego vehicle)
  bool planar = false;       ///< smoothed more (road, walls)
  bool sky = false;          ///< rays carve to infinity, never a surface
  std::vector<Rgb> aliases;  ///< further colours of colour-coded input
};

/// Grey of facets without a class.
constexpr Rgb kUnlabelledColor{128, 128, 128};

class LabelSet {
 public:
  LabelSet() = default;

  /// Throws std::invalid_argument with all problems at once (double ids, names or colours, ...).
  explicit LabelSet(std::vector<ClassInfo> classes);

  /// Reads a YAML label file. Throws std::invalid_argument with the path and all problems at once.
  static LabelSet load(const std::string& path);

  const std::vector<ClassInfo>& classes() const { return classes_; }
  bool empty() const { return classes_.empty(); }

  /// The class with this id, nullptr if it is not configured.
  const ClassInfo* find(Label id) const;
  const ClassInfo* find_name(const std::string& name) const;
  /// The class with this colour or alias, nullptr if there is none.
  const ClassInfo* find_color(const Rgb& color) const;

  /// Ids of the classes that are no surface (sky), ascending.
  std::vector<Label> sky_ids() const;

  /// The class's name, "unlabelled" or "class N" for ids that are not configured.
  std::string name_of(Label id) const;
  Rgb color_of(Label id) const;

 private:
  std::vector<ClassInfo> classes_;  // ascending ids
};

}  // namespace facet_mapping
