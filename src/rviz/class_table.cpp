// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/class_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace facet_mapping {
namespace {

constexpr const char* kFurtherClasses = "all further classes";
constexpr Rgb kUnlabelledColor{128, 128, 128};
constexpr Rgb kUnknownColor{255, 0, 255};
// Perceived brightness grows along the ramp, so that it reads without a legend.
constexpr std::array<std::array<double, 3>, 5> kRamp{
    {{40, 30, 110}, {45, 90, 160}, {30, 150, 135}, {120, 205, 80}, {250, 230, 40}}};
constexpr std::array<Rgb, 12> kChunkColors{{{141, 211, 199},
                                            {255, 237, 111},
                                            {190, 186, 218},
                                            {251, 128, 114},
                                            {128, 177, 211},
                                            {253, 180, 98},
                                            {179, 222, 105},
                                            {252, 205, 229},
                                            {217, 217, 217},
                                            {188, 128, 189},
                                            {204, 235, 197},
                                            {120, 120, 200}}};

std::uint8_t byte_of(double unit) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(unit, 0.0, 1.0)));
}

void write_texel(const Rgb& color, std::uint8_t alpha, std::uint8_t* texel) {
  std::copy(color.begin(), color.end(), texel);
  texel[3] = alpha;
}

void forget_palette(ClassStyle* style) {
  style->name = "class " + std::to_string(style->id);
  style->color = kUnknownColor;
  style->in_palette = false;
}

}  // namespace

ClassTable::ClassTable() {
  ClassStyle unlabelled;
  unlabelled.name = "unlabelled";
  unlabelled.color = kUnlabelledColor;
  unlabelled.in_palette = true;
  styles_.push_back(unlabelled);
  slots_[kUnlabelled] = 0;
}

std::uint8_t ClassTable::slot_of(Label id) {
  const auto known = slots_.find(id);
  if (known != slots_.end()) {
    return known->second;
  }
  if (styles_.size() < kSlots) {
    ClassStyle style;
    style.id = id;
    forget_palette(&style);
    styles_.push_back(style);
  } else {
    styles_.back().name = kFurtherClasses;
  }
  const auto slot = static_cast<std::uint8_t>(styles_.size() - 1);
  slots_[id] = slot;
  return slot;
}

ClassSlots ClassTable::slots_of(const std::vector<Label>& labels) {
  ClassSlots slots{{kUnlabelled, 0}};
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (k == 0 || labels[k] != labels[k - 1]) {  // runs of one class are long
      slots.emplace(labels[k], slot_of(labels[k]));
    }
  }
  return slots;
}

void ClassTable::set_palette(const ClassPalette& palette) {
  std::for_each(
      styles_.begin() + 1, styles_.end(), [](ClassStyle& style) { forget_palette(&style); });
  for (const PaletteClass& entry : palette.classes) {
    ClassStyle& style = styles_[slot_of(entry.id)];
    if (style.id != entry.id) {
      continue;  // shares the last slot
    }
    style.name = entry.name;
    style.color = {byte_of(entry.color.r), byte_of(entry.color.g), byte_of(entry.color.b)};
    style.in_palette = true;
  }
  if (slots_.size() > styles_.size()) {
    styles_.back().name = kFurtherClasses;
  }
}

std::vector<std::uint8_t> ClassTable::texels() const {
  std::vector<std::uint8_t> texels(4 * kRows * kSlots, 255);
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    const ClassStyle style = slot < styles_.size() ? styles_[slot] : ClassStyle();
    write_texel(style.color, style.visible ? byte_of(style.alpha) : 0, &texels[4 * slot]);
    write_texel(
        ramp_color(static_cast<double>(slot) / (kSlots - 1)), 255, &texels[4 * (kSlots + slot)]);
    write_texel(kChunkColors[slot % kChunkColors.size()], 255, &texels[4 * (2 * kSlots + slot)]);
  }
  return texels;
}

bool ClassTable::is_translucent() const {
  return std::any_of(styles_.begin(), styles_.end(), [](const ClassStyle& style) {
    return style.visible && style.alpha > 0.0F && style.alpha < 1.0F;
  });
}

Rgb ramp_color(double value) {
  const double place = std::clamp(std::isfinite(value) ? value : 0.0, 0.0, 1.0) *
                       static_cast<double>(kRamp.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(place), kRamp.size() - 2);
  const double part = place - static_cast<double>(low);
  Rgb color{};
  for (std::size_t k = 0; k < 3; ++k) {
    color[k] = static_cast<std::uint8_t>(
        std::lround((1.0 - part) * kRamp[low][k] + part * kRamp[low + 1][k]));
  }
  return color;
}

std::vector<double> area_shares(const std::vector<double>& area_by_slot_m2) {
  const double total = std::accumulate(area_by_slot_m2.begin(), area_by_slot_m2.end(), 0.0);
  std::vector<double> shares(area_by_slot_m2.size(), 0.0);
  if (total > 0.0) {
    std::transform(
        area_by_slot_m2.begin(), area_by_slot_m2.end(), shares.begin(), [total](double area) {
          return area / total;
        });
  }
  return shares;
}

}  // namespace facet_mapping
