// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/class_table.h"

#include <limits>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

ClassPalette palette_of(Label id, const std::string& name, float red) {
  ClassPalette palette;
  PaletteClass entry;
  entry.id = id;
  entry.name = name;
  entry.color.r = red;
  entry.color.a = 1.0F;
  palette.classes.push_back(entry);
  return palette;
}

/// Red, green, blue, alpha.
std::array<int, 4> texel(const ClassTable& table, std::size_t row, std::size_t column) {
  const std::vector<std::uint8_t> texels = table.texels();
  const std::size_t start = 4 * (row * ClassTable::kSlots + column);
  return {texels[start], texels[start + 1], texels[start + 2], texels[start + 3]};
}

TEST(ClassTable, APaletteThatComesLaterChangesNoSlot) {
  ClassTable table;
  EXPECT_EQ(table.slot_of(kUnlabelled), 0);
  const std::uint8_t slot = table.slot_of(4711);
  EXPECT_FALSE(table.styles()[slot].in_palette);
  table.set_palette(palette_of(4711, "kerb", 1.0F));
  EXPECT_EQ(table.slot_of(4711), slot);
  EXPECT_EQ(table.styles()[slot].name, "kerb");
  EXPECT_TRUE(table.styles()[slot].in_palette);
  EXPECT_EQ(texel(table, 0, slot), (std::array<int, 4>{255, 0, 0, 255}));
}

TEST(ClassTable, AnInvisibleClassHasAlphaZeroAndKeepsItsColor) {
  ClassTable table;
  table.set_palette(palette_of(1, "road", 0.2F));
  const std::uint8_t slot = table.slot_of(1);
  table.style(slot).visible = false;
  EXPECT_EQ(texel(table, 0, slot), (std::array<int, 4>{51, 0, 0, 0}));
  EXPECT_FALSE(table.is_translucent());
}

TEST(ClassTable, OpacityGoesIntoTheTexture) {
  ClassTable table;
  const std::uint8_t slot = table.slot_of(1);
  table.style(slot).alpha = 0.4F;
  EXPECT_EQ(texel(table, 0, slot)[3], 102);
  EXPECT_TRUE(table.is_translucent());
}

TEST(ClassTable, ANewPaletteReplacesTheOldOne) {
  ClassTable table;
  table.set_palette(palette_of(1, "road", 0.2F));
  const std::uint8_t slot = table.slot_of(1);
  table.style(slot).visible = false;
  table.set_palette(palette_of(2, "wall", 0.4F));
  EXPECT_EQ(table.slot_of(1), slot);
  EXPECT_EQ(table.styles()[slot].name, "class 1");
  EXPECT_FALSE(table.styles()[slot].in_palette);
  EXPECT_FALSE(table.styles()[slot].visible);
  EXPECT_EQ(table.styles()[slot].color, (Rgb{255, 0, 255}));
  EXPECT_EQ(table.styles()[0].name, "unlabelled");
  EXPECT_EQ(table.styles()[table.slot_of(2)].name, "wall");
}

TEST(ClassTable, MoreClassesThanSlotsShareTheLast) {
  ClassTable table;
  for (Label id = 0; id < 1000; ++id) {
    table.slot_of(id);
  }
  EXPECT_EQ(table.styles().size(), ClassTable::kSlots);
  EXPECT_EQ(table.slot_of(999), 255);
  EXPECT_EQ(table.slot_of(3), 4);
  table.set_palette(palette_of(999, "late", 1.0F));
  EXPECT_EQ(table.styles().back().name, "all further classes");
}

TEST(ClassTable, ColorsOutsideTheRangeAreClamped) {
  ClassTable table;
  table.set_palette(palette_of(1, "bright", 7.0F));
  table.set_palette(palette_of(2, "dark", -1.0F));
  EXPECT_EQ(texel(table, 0, table.slot_of(1))[0], 255);
  EXPECT_EQ(texel(table, 0, table.slot_of(2))[0], 0);
}

TEST(ClassTable, TheSecondRowIsTheRamp) {
  const ClassTable table;
  for (const std::size_t column : {0, 77, 255}) {
    const Rgb color = ramp_color(static_cast<double>(column) / 255.0);
    EXPECT_EQ(texel(table, 1, column), (std::array<int, 4>{color[0], color[1], color[2], 255}));
  }
}

TEST(RampColor, GrowsBrighterAndIsClamped) {
  int last = -1;
  for (int k = 0; k <= 100; ++k) {
    const Rgb color = ramp_color(k / 100.0);
    const int brightness = 3 * color[0] + 6 * color[1] + color[2];
    EXPECT_GT(brightness, last) << k;
    last = brightness;
  }
  EXPECT_EQ(ramp_color(-3.0), ramp_color(0.0));
  EXPECT_EQ(ramp_color(9.0), ramp_color(1.0));
  EXPECT_EQ(ramp_color(std::numeric_limits<double>::quiet_NaN()), ramp_color(0.0));
}

TEST(AreaShares, SumToOneOrAreZero) {
  EXPECT_EQ(area_shares({1.0, 0.0, 3.0}), (std::vector<double>{0.25, 0.0, 0.75}));
  EXPECT_EQ(area_shares({0.0, 0.0}), (std::vector<double>{0.0, 0.0}));
}

}  // namespace
}  // namespace facet_mapping
