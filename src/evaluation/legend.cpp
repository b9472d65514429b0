// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/evaluation/legend.h"

#include <set>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "facet_mapping/geometry/label.h"

namespace facet_mapping {
namespace {

constexpr int kRowHeight = 26;
constexpr int kSwatch = 16;
constexpr int kMargin = 8;
constexpr double kFontScale = 0.45;
const cv::Scalar kInk(40, 40, 40);

int text_width(const std::string& text) {
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, nullptr).width;
}

void write_text(cv::Mat& picture, const std::string& text, const cv::Point& left_bottom) {
  cv::putText(
      picture, text, left_bottom, cv::FONT_HERSHEY_SIMPLEX, kFontScale, kInk, 1, cv::LINE_AA);
}

struct Entry {
  std::string text;
  cv::Scalar color;
  cv::Point place;  // upper left corner of the swatch
};

std::vector<Entry> entries_of(const cv::Mat& classes, const LabelSet& labels) {
  std::set<Label> ids(classes.begin<Label>(), classes.end<Label>());
  ids.erase(kUnlabelled);
  std::vector<Entry> entries;
  for (const Label id : ids) {
    const Rgb rgb = labels.color_of(id);
    entries.push_back({labels.name_of(id), cv::Scalar(rgb[2], rgb[1], rgb[0]), {}});
  }
  return entries;
}

// Left to right, top to bottom; returns the height that they take.
int place(std::vector<Entry>& entries, int width) {
  int column = kMargin;
  int row = 0;
  for (Entry& entry : entries) {
    const int needed = kSwatch + kMargin / 2 + text_width(entry.text) + 2 * kMargin;
    if (column + needed > width && column > kMargin) {
      column = kMargin;
      ++row;
    }
    entry.place = {column, row * kRowHeight + (kRowHeight - kSwatch) / 2};
    column += needed;
  }
  return (row + 1) * kRowHeight;
}

cv::Mat with_space_below(const cv::Mat& picture, int height) {
  cv::Mat larger(picture.rows + height, picture.cols, CV_8UC3, cv::Scalar(255, 255, 255));
  picture.copyTo(larger.rowRange(0, picture.rows));
  return larger;
}

}  // namespace

cv::Mat with_class_legend(const cv::Mat& picture, const cv::Mat& classes, const LabelSet& labels) {
  std::vector<Entry> entries = entries_of(classes, labels);
  if (entries.empty()) {
    return picture.clone();
  }
  cv::Mat larger = with_space_below(picture, place(entries, picture.cols));
  cv::Mat legend = larger.rowRange(picture.rows, larger.rows);
  for (const Entry& entry : entries) {
    cv::rectangle(
        legend, cv::Rect(entry.place, cv::Size(kSwatch, kSwatch)), entry.color, cv::FILLED);
    write_text(legend, entry.text, entry.place + cv::Point(kSwatch + kMargin / 2, kSwatch - 4));
  }
  return larger;
}

cv::Mat with_scale_legend(const cv::Mat& picture,
                          const std::string& left_text,
                          const std::string& right_text,
                          bool reversed) {
  cv::Mat larger = with_space_below(picture, kRowHeight);
  cv::Mat legend = larger.rowRange(picture.rows, larger.rows);
  const int left = 2 * kMargin + text_width(left_text);
  const int right = picture.cols - 2 * kMargin - text_width(right_text);
  const int baseline = (kRowHeight + kSwatch) / 2 - 4;
  write_text(legend, left_text, {kMargin, baseline});
  if (right <= left) {
    return larger;
  }
  cv::Mat levels(kSwatch, right - left, CV_8U);
  for (int column = 0; column < levels.cols; ++column) {
    const int level = 255 * column / levels.cols;
    levels.col(column).setTo(cv::Scalar(reversed ? 255 - level : level));
  }
  cv::Mat bar;
  cv::applyColorMap(levels, bar, cv::COLORMAP_TURBO);
  bar.copyTo(legend(cv::Rect(left, (kRowHeight - kSwatch) / 2, bar.cols, bar.rows)));
  write_text(legend, right_text, {right + kMargin, baseline});
  return larger;
}

}  // namespace facet_mapping
