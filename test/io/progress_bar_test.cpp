// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/io/progress_bar.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

TEST(ProgressBar, PlainLinesAtEveryTenth) {
  std::ostringstream output;
  ProgressBar bar(output, "frames", false);
  for (std::size_t k = 1; k <= 1000; ++k) {
    bar.update(k, 1000);
  }
  const std::string text = output.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11);
  EXPECT_NE(text.find("frames: 50 % (500 of 1000)\n"), std::string::npos) << text;
  EXPECT_EQ(text.substr(text.size() - 29), "frames: 100 % (1000 of 1000)\n");
}

TEST(ProgressBar, ABarOnATerminalEndsWithOneLineBreak) {
  std::ostringstream output;
  ProgressBar bar(output, "frames", true);
  for (std::size_t k = 1; k <= 4; ++k) {
    bar.update(k, 4);
    bar.update(k, 4);
  }
  const std::string text = output.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 4);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_NE(text.find("[###############               ] 2/4"), std::string::npos) << text;
}

TEST(ProgressBar, NothingToDoIsDone) {
  std::ostringstream output;
  ProgressBar(output, "frames", false).update(0, 0);
  EXPECT_EQ(output.str(), "frames: 100 % (0 of 0)\n");
}

}  // namespace
}  // namespace facet_mapping
