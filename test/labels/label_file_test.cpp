// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {
namespace {

class LabelFile : public testing::Test {
 protected:
  LabelFile()
      : path_(testing::TempDir() + "label_file_test_" + std::to_string(getpid()) + ".yaml") {}
  ~LabelFile() override { std::filesystem::remove(path_); }

  std::string message_for(const std::string& text) {
    std::ofstream(path_) << text;
    try {
      LabelSet::load(path_);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  const std::string path_;
};

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " not in\n" << message;
  }
}

TEST_F(LabelFile, ReadsEveryField) {
  std::ofstream(path_) << "classes:\n"
                          "  - {id: 300, name: tram, color: [1, 2, 3], dynamic: true}\n"
                          "  - id: 0\n"
                          "    name: field\n"
                          "    color: [4, 5, 6]\n"
                          "    ignore: true\n"
                          "    planar: true\n"
                          "    sky: true\n"
                          "    aliases: [[7, 8, 9], [10, 11, 12]]\n";
  const LabelSet labels = LabelSet::load(path_);
  ASSERT_EQ(labels.classes().size(), 2U);
  const ClassInfo& field = labels.classes()[0];
  EXPECT_TRUE(field.ignore && field.planar && field.sky && !field.dynamic);
  EXPECT_EQ(field.aliases, (std::vector<Rgb>{{7, 8, 9}, {10, 11, 12}}));
  const ClassInfo& tram = labels.classes()[1];
  EXPECT_EQ(tram.id, 300);
  EXPECT_EQ(tram.color, (Rgb{1, 2, 3}));
  EXPECT_TRUE(tram.dynamic && !tram.ignore && !tram.planar && !tram.sky);
}

TEST_F(LabelFile, ListsAllProblemsWithPathAndLine) {
  const std::string message = message_for(
      "classes:\n"
      "  - {id: 1, name: a, color: [0, 0, 256]}\n"
      "  - {id: 1, name: b, color: [0, 0, 1], dinamic: true}\n"
      "  - {id: 65535, name: c, color: [0, 0, 2], sky: perhaps}\n"
      "  - {id: -3, name: d, color: [0, 0]}\n"
      "  - {name: [e], color: [0, 0, 1], aliases: 5}\n"
      "  - nothing\n"
      "  - {id: 2, id: 3, name: f, color: [x, 0, 0]}\n"
      "colours: 3\n");
  expect_parts(message,
               {path_,
                "line 2: color channel is 256",
                "line 3: id 1 is already used at line 2",
                "line 3: unknown key 'dinamic'",
                "line 4: id 65535 is reserved",
                "line 4: sky must be true or false",
                "line 5: id is -3",
                "line 5: color must be [red, green, blue]",
                "line 6: the class has no id",
                "line 6: name must be a text",
                "line 6: color [0, 0, 1] is already used at line 3",
                "line 6: aliases must be a list",
                "line 7: a class must be a map",
                "line 8: the key 'id' stands twice",
                "line 8: color channel must be a whole number",
                "line 9: unknown key 'colours'",
                "15 problems"});
}

TEST_F(LabelFile, SaysWhereTheYamlBreaks) {
  expect_parts(message_for("classes:\n  - {id: 1, name: a\n  - ]\n"), {path_, "not valid YAML"});
}

TEST_F(LabelFile, RefusesFilesWithoutClasses) {
  expect_parts(message_for(""), {path_, "must hold a map"});
  expect_parts(message_for("- 1\n"), {"must hold a map"});
  expect_parts(message_for("{}\n"), {"'classes' is missing"});
  expect_parts(message_for("classes: []\n"), {"at least one class"});
}

TEST_F(LabelFile, RefusesMissingFilesAndFolders) {
  EXPECT_THROW(LabelSet::load("/no/such/file.yaml"), std::invalid_argument);
  EXPECT_THROW(LabelSet::load(testing::TempDir()), std::invalid_argument);
}

}  // namespace
}  // namespace facet_mapping
