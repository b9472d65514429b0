// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of this room share.
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping::test {

inline ClassInfo make_class(Label id, const std::string& name, const Rgb& color) {
  ClassInfo info;
  info.id = id;
  info.name = name;
  info.color = color;
  return info;
}

/// Three classes that count and one that is ignored.
inline LabelSet three_classes() {
  ClassInfo none = make_class(9, "void", {0, 0, 0});
  none.ignore = true;
  return LabelSet({make_class(3, "red", {255, 0, 0}),
                   make_class(5, "green", {0, 255, 0}),
                   make_class(8, "blue", {0, 0, 255}),
                   none});
}

/// What() of the exception that an action throws; "" if it throws none.
template <typename Error, typename Action>
std::string sentence_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder of its own for each test.
class FolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string(info->test_suite_name()) + "_" + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

}  // namespace facet_mapping::test
