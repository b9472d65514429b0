// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "color_decoder.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "label_checks.h"

namespace facet_mapping::detail {
namespace {

class ColorTable {
 public:
  explicit ColorTable(const LabelSet& labels) {
    for (const ClassInfo& info : labels.classes()) {
      const Label label = info.ignore ? kUnlabelled : info.id;
      labels_.emplace(pack_color(info.color), label);
      for (const Rgb& alias : info.aliases) {
        labels_.emplace(pack_color(alias), label);
      }
    }
  }

  const Label* find(std::uint32_t color) const {
    const auto found = labels_.find(color);
    return found == labels_.end() ? nullptr : &found->second;
  }

  std::size_t size() const { return labels_.size(); }

 private:
  std::unordered_map<std::uint32_t, Label> labels_;
};

/// The set of the unknown colours met, one bit per possible colour (2 MB, made when needed).
class ColorCounter {
 public:
  void add(std::uint32_t color) {
    if (seen_.empty()) {
      seen_.resize(1U << 24U, false);
    }
    distinct_ += seen_[color] ? 0 : 1;
    seen_[color] = true;
  }

  std::size_t distinct() const { return distinct_; }

 private:
  std::vector<bool> seen_;
  std::size_t distinct_ = 0;
};

/// Looks each colour up once per run of equal pixels: label images are made of long runs.
class RunDecoder {
 public:
  explicit RunDecoder(const ColorTable& table) : table_(table) {}

  Label decode(std::uint32_t color) {
    if (color != last_color_) {
      last_color_ = color;
      const Label* label = table_.find(color);
      known_ = label != nullptr;
      label_ = known_ ? *label : kUnlabelled;
      if (!known_) {
        unknown_colors_.add(color);
      }
    }
    unknown_pixels_ += known_ ? 0 : 1;
    return label_;
  }

  std::size_t unknown_pixels() const { return unknown_pixels_; }
  std::size_t unknown_colors() const { return unknown_colors_.distinct(); }

 private:
  const ColorTable& table_;
  std::uint32_t last_color_ = 0xffffffffU;  // no 24-bit colour
  bool known_ = false;
  Label label_ = kUnlabelled;
  std::size_t unknown_pixels_ = 0;
  ColorCounter unknown_colors_;
};

cv::Mat decode_all(const cv::Mat& image, bool red_first, RunDecoder& decoder) {
  const int red = red_first ? 0 : 2;
  cv::Mat decoded(image.size(), CV_16UC1);
  for (int y = 0; y < image.rows; ++y) {
    const auto* source = image.ptr<cv::Vec3b>(y);
    auto* target = decoded.ptr<Label>(y);
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec3b& pixel = source[x];
      target[x] = decoder.decode(pack_color({pixel[red], pixel[1], pixel[2 - red]}));
    }
  }
  return decoded;
}

/// True if exchanging red and blue would explain far more pixels. Greys and purples of a swapped
/// image still match, so that few unknown pixels are enough to look.
bool is_swapped(const cv::Mat& image,
                bool red_first,
                const ColorTable& table,
                std::size_t unknown_pixels) {
  if (20 * unknown_pixels < image.total()) {
    return false;
  }
  RunDecoder swapped(table);
  decode_all(image, !red_first, swapped);
  return 4 * swapped.unknown_pixels() < unknown_pixels;
}

}  // namespace

cv::Mat decode_colors(const cv::Mat& image,
                      bool red_first,
                      const LabelSet& labels,
                      LabelImageReport& report) {
  const ColorTable table(labels);
  RunDecoder decoder(table);
  cv::Mat decoded = decode_all(image, red_first, decoder);
  report.unknown_color_pixels = decoder.unknown_pixels();
  report.looks_swapped = is_swapped(image, red_first, table, decoder.unknown_pixels());
  // Another palette has about as many colours as this one; JPEG and smooth resizing make hundreds.
  const std::size_t many_colors = std::max<std::size_t>(64, 2 * table.size());
  report.looks_lossy = !report.looks_swapped && decoder.unknown_colors() > many_colors;
  return decoded;
}

}  // namespace facet_mapping::detail
