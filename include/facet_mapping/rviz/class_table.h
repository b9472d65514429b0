// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The classes that a display shows: where each stands in the palette texture, and how it looks.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <facet_mapping/ClassPalette.h>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping {

/// Red, green, blue, 0..255.
using Rgb = std::array<std::uint8_t, 3>;

/// Where the classes of a chunk stand in a ClassTable.
using ClassSlots = std::map<Label, std::uint8_t>;

struct ClassStyle {
  Label id = kUnlabelled;
  std::string name;
  Rgb color{};
  float alpha = 1.0F;  ///< 0..1
  bool visible = true;
  bool in_palette = false;  ///< false: a label was met that the palette does not name
};

/// Facets carry slots, not class ids, so that neither a late palette nor a change of colours
/// touches them. Slot 0 is that of unlabelled facets; slots are given in the order of need.
class ClassTable {
 public:
  static constexpr std::size_t kSlots = 256;
  /// Rows of the texture: class colours by slot, a ramp from low to high, colours of chunks; the
  /// fourth only makes it a power of two.
  static constexpr std::size_t kRows = 4;

  ClassTable();

  /// The slot of a class, made if new. All classes beyond the last slot share it.
  std::uint8_t slot_of(Label id);
  /// Of all labels, and of unlabelled facets.
  ClassSlots slots_of(const std::vector<Label>& labels);
  /// Takes names and colours; visibility and opacity stay. Classes that it does not name lose
  /// theirs.
  void set_palette(const ClassPalette& palette);

  /// By slot.
  const std::vector<ClassStyle>& styles() const { return styles_; }
  ClassStyle& style(std::size_t slot) { return styles_.at(slot); }

  /// kRows rows of kSlots texels: red, green, blue, alpha. An invisible class has alpha 0.
  std::vector<std::uint8_t> texels() const;
  /// True if a shown class is neither opaque nor invisible.
  bool is_translucent() const;

 private:
  std::vector<ClassStyle> styles_;
  ClassSlots slots_;
};

/// From dark blue (0) over green to yellow (1); values outside are clamped.
Rgb ramp_color(double value);

/// Share of each slot in the whole area, 0..1; all zero without area.
std::vector<double> area_shares(const std::vector<double>& area_by_slot_m2);

}  // namespace facet_mapping
