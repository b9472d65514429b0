// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/rviz/refine_report.h"

#include <set>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

std::string value_of(const std::vector<ReportLine>& lines, const std::string& what) {
  for (const ReportLine& line : lines) {
    if (line.what == what) {
      return line.value;
    }
  }
  return "none";
}

Refine::Response response() {
  Refine::Response response;
  response.facets_before = 999;
  response.facets_after = 1234567;
  response.relabelled = 1000;
  response.views = 12;
  response.before.photometric = 0.25;
  response.after.photometric = 0.125;
  response.seconds = 7.25;
  response.peak_memory = 300;
  return response;
}

TEST(RefineReport, EveryCodeHasItsOwnWord) {
  std::set<std::string> words;
  for (int code = Status::OK; code <= Status::INTERNAL + 1; ++code) {
    words.insert(status_word(static_cast<std::uint8_t>(code)));
  }
  EXPECT_EQ(words.size(), 8U);
  EXPECT_EQ(status_word(Status::BUSY), "BUSY");
  EXPECT_EQ(status_word(77), "code 77");
}

TEST(RefineReport, TellsWhatHasChanged) {
  const auto lines = report_lines(response(), false);
  EXPECT_EQ(value_of(lines, "Facets"), "999 -> 1 234 567");
  EXPECT_EQ(value_of(lines, "Relabelled"), "1 000");
  EXPECT_EQ(value_of(lines, "Photometric"), "0.25 -> 0.125");
  EXPECT_EQ(value_of(lines, "Time"), "7.2 s, 12 keyframes, about 300 MiB");
}

TEST(RefineReport, ADryRunHasChangedNothing) {
  const auto lines = report_lines(response(), true);
  EXPECT_EQ(value_of(lines, "Relabelled"), "none");
  EXPECT_EQ(value_of(lines, "Photometric"), "0.25");
  EXPECT_EQ(value_of(lines, "Time"), "about 7.2 s, 12 keyframes");
}

TEST(RefineReport, NothingWhereNothingWasDone) {
  EXPECT_TRUE(report_lines({}, false).empty());
  EXPECT_TRUE(report_lines({}, true).empty());
}

TEST(RefineReport, ProgressCountsIterationsFromOne) {
  RefineProgress progress;
  progress.level = 1;
  progress.iteration = 2;
  progress.seconds = 12.46;
  progress.fraction = 0.3;
  EXPECT_EQ(progress_text(progress), "level 1, iteration 3, 12.5 s, 30 %");
}

}  // namespace
}  // namespace facet_mapping
