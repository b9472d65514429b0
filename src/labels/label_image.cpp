// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/labels/label_image.h"

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "color_decoder.h"

namespace facet_mapping {
namespace {

struct Encoding {
  const char* name;
  int type;
};

constexpr Encoding kIdEncodings[] = {{"mono8", CV_8UC1},
                                     {"8UC1", CV_8UC1},
                                     {"mono16", CV_16UC1},
                                     {"16UC1", CV_16UC1},
                                     {"32SC1", CV_32SC1}};
constexpr Encoding kColorEncodings[] = {{"rgb8", CV_8UC3}, {"bgr8", CV_8UC3}};

template <std::size_t N>
bool is_known(const Encoding (&known)[N], const std::string& name) {
  for (const Encoding& encoding : known) {
    if (name == encoding.name) {
      return true;
    }
  }
  return false;
}

template <std::size_t N>
void check_type(const Encoding (&known)[N], const std::string& name, int type) {
  for (const Encoding& encoding : known) {
    if (name == encoding.name && type != encoding.type) {
      throw std::invalid_argument("The label image says encoding '" + name +
                                  "' but its pixels are of " + cv::typeToString(type) +
                                  "; send pixels that fit the encoding");
    }
  }
}

constexpr int kIds = std::numeric_limits<Label>::max() + 1;

/// What every possible id becomes; `known` tells unlabelled classes from unknown ids.
struct IdTable {
  std::vector<Label> label = std::vector<Label>(kIds, kUnlabelled);
  std::vector<std::uint8_t> known = std::vector<std::uint8_t>(kIds, 0);

  explicit IdTable(const LabelSet& labels) {
    known[kUnlabelled] = 1;  // images made by this program say "unlabelled" that way
    for (const ClassInfo& info : labels.classes()) {
      label[info.id] = info.ignore ? kUnlabelled : info.id;
      known[info.id] = 1;
    }
  }
};

template <typename Pixel>
cv::Mat decode_ids(const cv::Mat& image, const LabelSet& labels, LabelImageReport& report) {
  const IdTable table(labels);
  cv::Mat decoded(image.size(), CV_16UC1);
  for (int y = 0; y < image.rows; ++y) {
    const auto* source = image.ptr<Pixel>(y);
    auto* target = decoded.ptr<Label>(y);
    for (int x = 0; x < image.cols; ++x) {
      const int id = source[x];
      const bool known = id >= 0 && id < kIds && table.known[id] != 0;
      target[x] = known ? table.label[id] : kUnlabelled;
      if (!known) {
        ++report.unknown_ids[id];
      }
    }
  }
  return decoded;
}

cv::Mat decode_id_image(const cv::Mat& image, const LabelSet& labels, LabelImageReport& report) {
  switch (image.depth()) {
    case CV_8U:
      return decode_ids<std::uint8_t>(image, labels, report);
    case CV_16U:
      return decode_ids<std::uint16_t>(image, labels, report);
    default:
      return decode_ids<std::int32_t>(image, labels, report);
  }
}

void check_label_image(const cv::Mat& labels) {
  if (labels.empty() || labels.type() != CV_16UC1) {
    throw std::invalid_argument(
        "A decoded label image must be a non-empty CV_16UC1 image of class ids");
  }
}

/// Index of the source pixel whose area holds the centre of the target pixel.
std::vector<int> nearest_indices(int source_size, int target_size) {
  std::vector<int> indices(static_cast<std::size_t>(target_size));
  for (int i = 0; i < target_size; ++i) {
    const std::int64_t twice_center = 2 * static_cast<std::int64_t>(i) + 1;
    indices[i] = static_cast<int>(twice_center * source_size / (2LL * target_size));
  }
  return indices;
}

std::string percent(std::size_t part, std::size_t whole) {
  const std::size_t rounded = whole == 0 ? 0 : (100 * part + whole / 2) / whole;
  return std::to_string(part) + " of " + std::to_string(whole) + " pixels (" +
         std::to_string(rounded) + " %)";
}

std::string unknown_ids_text(const LabelImageReport& report) {
  constexpr std::size_t kMostListed = 8;
  std::string list;
  std::size_t pixels = 0;
  std::size_t listed = 0;
  for (const auto& [id, count] : report.unknown_ids) {
    pixels += count;
    if (listed++ < kMostListed) {
      list += (list.empty() ? "" : ", ") + std::to_string(id);
    }
  }
  if (report.unknown_ids.size() > kMostListed) {
    list += ", ...";
  }
  return percent(pixels, report.pixels) + " have ids that the label file does not know (" + list +
         "); they count as unlabelled: add the classes or choose the label file of this network";
}

std::string unknown_colors_text(const LabelImageReport& report) {
  std::string text = percent(report.unknown_color_pixels, report.pixels) +
                     " have colours that the label file does not know; they count as unlabelled: ";
  if (report.looks_swapped) {
    return text + "red and blue look swapped, say rgb8 for bgr8 or the other way round";
  }
  if (report.looks_lossy) {
    return text +
           "the image looks lossy-compressed or interpolated (or is no label image), send it "
           "uncompressed or as PNG and never resize it smoothly";
  }
  return text + "add the colours as aliases or choose the label file of this network";
}

}  // namespace

std::string LabelImageReport::to_string() const {
  if (clean()) {
    return "all " + std::to_string(pixels) + " pixels are of known classes";
  }
  std::string text = unknown_ids.empty() ? "" : unknown_ids_text(*this);
  if (unknown_color_pixels > 0) {
    text += (text.empty() ? "" : "; ") + unknown_colors_text(*this);
  }
  return text;
}

cv::Mat decode_label_image(const cv::Mat& image,
                           const std::string& encoding,
                           const LabelSet& labels,
                           LabelImageReport* report) {
  if (image.empty() || labels.empty()) {
    throw std::invalid_argument(image.empty() ? "The label image has no pixels"
                                              : "The class list is empty; load a label file first");
  }
  check_type(kIdEncodings, encoding, image.type());
  check_type(kColorEncodings, encoding, image.type());
  LabelImageReport found;
  found.pixels = image.total();
  cv::Mat decoded;
  if (is_known(kIdEncodings, encoding)) {
    decoded = decode_id_image(image, labels, found);
  } else if (is_known(kColorEncodings, encoding)) {
    decoded = detail::decode_colors(image, encoding == "rgb8", labels, found);
  } else {
    throw std::invalid_argument("A label image of encoding '" + encoding +
                                "' cannot be read; send class ids as mono8, 8UC1, mono16, 16UC1 "
                                "or 32SC1, or class colours as rgb8 or bgr8");
  }
  if (report != nullptr) {
    *report = found;
  }
  return decoded;
}

cv::Mat resize_label_image(const cv::Mat& labels, const cv::Size& size) {
  check_label_image(labels);
  if (size.width <= 0 || size.height <= 0) {
    throw std::invalid_argument("A label image cannot be resized to " + std::to_string(size.width) +
                                " x " + std::to_string(size.height) + " pixels");
  }
  const std::vector<int> columns = nearest_indices(labels.cols, size.width);
  const std::vector<int> rows = nearest_indices(labels.rows, size.height);
  cv::Mat resized(size, CV_16UC1);
  for (int y = 0; y < size.height; ++y) {
    const auto* source = labels.ptr<Label>(rows[y]);
    auto* target = resized.ptr<Label>(y);
    for (int x = 0; x < size.width; ++x) {
      target[x] = source[columns[x]];
    }
  }
  return resized;
}

cv::Mat color_label_image(const cv::Mat& labels, const LabelSet& label_set) {
  check_label_image(labels);
  std::vector<cv::Vec3b> bgr(kIds, {kUnlabelledColor[2], kUnlabelledColor[1], kUnlabelledColor[0]});
  for (const ClassInfo& info : label_set.classes()) {
    bgr[info.id] = {info.color[2], info.color[1], info.color[0]};
  }
  cv::Mat picture(labels.size(), CV_8UC3);
  for (int y = 0; y < labels.rows; ++y) {
    const auto* source = labels.ptr<Label>(y);
    auto* target = picture.ptr<cv::Vec3b>(y);
    for (int x = 0; x < labels.cols; ++x) {
      target[x] = bgr[source[x]];
    }
  }
  return picture;
}

}  // namespace facet_mapping
