// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/labels/label_set.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace facet_mapping {
namespace {

std::string shipped(const std::string& name) {
  return std::string(FACET_MAPPING_SOURCE_DIR) + "/config/labels/" + name + ".yaml";
}

ClassInfo make_class(Label id, const std::string& name, const Rgb& color) {
  ClassInfo info;
  info.id = id;
  info.name = name;
  info.color = color;
  return info;
}

std::string message_of(const std::vector<ClassInfo>& classes) {
  try {
    const LabelSet labels(classes);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(LabelSet, SkyIsWhatTheClassesSay) {
  ClassInfo sky = make_class(9, "above", {1, 2, 3});
  sky.sky = true;
  const LabelSet labels({make_class(4, "sky", {4, 5, 6}), sky});
  EXPECT_EQ(labels.sky_ids(), std::vector<Label>{9});
}

TEST(LabelSet, FindsByIdNameAndColor) {
  ClassInfo road = make_class(7, "road", {128, 64, 128});
  road.aliases = {{1, 2, 3}};
  const LabelSet labels({make_class(9, "sky", {70, 130, 180}), road});
  EXPECT_EQ(labels.classes().front().id, 7);
  ASSERT_NE(labels.find(9), nullptr);
  EXPECT_EQ(labels.find(9)->name, "sky");
  EXPECT_EQ(labels.find(8), nullptr);
  EXPECT_EQ(labels.find(kUnlabelled), nullptr);
  ASSERT_NE(labels.find_name("road"), nullptr);
  EXPECT_EQ(labels.find_name("road")->id, 7);
  EXPECT_EQ(labels.find_name("Road"), nullptr);
  ASSERT_NE(labels.find_color({1, 2, 3}), nullptr);
  EXPECT_EQ(labels.find_color({1, 2, 3})->id, 7);
  EXPECT_EQ(labels.find_color({70, 130, 180})->id, 9);
  EXPECT_EQ(labels.find_color({3, 2, 1}), nullptr);
}

TEST(LabelSet, NamesAndColorsEveryId) {
  const LabelSet labels({make_class(7, "road", {128, 64, 128})});
  EXPECT_EQ(labels.name_of(7), "road");
  EXPECT_EQ(labels.name_of(8), "class 8");
  EXPECT_EQ(labels.name_of(kUnlabelled), "unlabelled");
  EXPECT_EQ(labels.color_of(7), (Rgb{128, 64, 128}));
  EXPECT_EQ(labels.color_of(kUnlabelled), kUnlabelledColor);
}

TEST(LabelSet, RefusesDoubleValuesAllAtOnce) {
  ClassInfo last = make_class(3, "c", {1, 1, 1});
  last.aliases = {{2, 2, 2}, {9, 9, 9}, {9, 9, 9}};
  const std::string message = message_of({make_class(1, "a", {1, 1, 1}),
                                          make_class(1, "a", {2, 2, 2}),
                                          last,
                                          make_class(kUnlabelled, "", {4, 4, 4})});
  for (const char* part : {"7 problems",
                           "id 1 is already used at class number 1",
                           "name 'a' is already used",
                           "color [1, 1, 1] is already used at class number 1",
                           "color [2, 2, 2] is already used at class number 2",
                           "color [9, 9, 9] is already used at class number 3",
                           "65535 is reserved",
                           "the name is empty"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " not in\n" << message;
  }
}

TEST(LabelSet, RefusesNamesThatWouldBreakTextFiles) {
  EXPECT_NE(message_of({make_class(1, "a\nb", {1, 1, 1})}).find("line break"), std::string::npos);
}

class ShippedLabelFile : public testing::TestWithParam<const char*> {};

TEST_P(ShippedLabelFile, LoadsWithUniqueValues) {
  const LabelSet labels = LabelSet::load(shipped(GetParam()));
  std::set<Label> ids;
  std::set<std::string> names;
  std::set<Rgb> colors;
  bool has_ignored = false;
  bool has_dynamic = false;
  bool has_planar = false;
  for (const ClassInfo& info : labels.classes()) {
    EXPECT_TRUE(ids.insert(info.id).second) << info.id;
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_TRUE(colors.insert(info.color).second) << info.name;
    EXPECT_FALSE(info.sky && (info.planar || info.dynamic)) << info.name;
    has_ignored = has_ignored || info.ignore;
    has_dynamic = has_dynamic || info.dynamic;
    has_planar = has_planar || info.planar;
  }
  EXPECT_TRUE(has_ignored && has_dynamic && has_planar);
}

INSTANTIATE_TEST_SUITE_P(All,
                         ShippedLabelFile,
                         testing::Values("cityscapes", "kitti360", "semantic_kitti", "ade20k"));

struct Known {
  const char* file;
  std::size_t classes;
  Label id;
  const char* name;
  Rgb color;
};

class KnownClass : public testing::TestWithParam<Known> {};

TEST_P(KnownClass, IsAsPublished) {
  const Known& known = GetParam();
  const LabelSet labels = LabelSet::load(shipped(known.file));
  EXPECT_EQ(labels.classes().size(), known.classes);
  EXPECT_EQ(labels.name_of(known.id), known.name);
  EXPECT_EQ(labels.color_of(known.id), known.color);
}

INSTANTIATE_TEST_SUITE_P(All,
                         KnownClass,
                         testing::Values(Known{"cityscapes", 20, 13, "car", {0, 0, 142}},
                                         Known{"cityscapes", 20, 10, "sky", {70, 130, 180}},
                                         Known{"kitti360", 45, 34, "garage", {64, 128, 128}},
                                         Known{"kitti360", 45, 26, "car", {0, 0, 142}},
                                         Known{"semantic_kitti", 34, 10, "car", {100, 150, 245}},
                                         Known{
                                             "semantic_kitti", 34, 81, "traffic-sign", {255, 0, 0}},
                                         Known{"ade20k", 151, 7, "road", {140, 140, 140}},
                                         Known{"ade20k", 151, 150, "flag", {92, 0, 255}}));

TEST(ShippedLabelFiles, MarkSkyWhereThereIsOne) {
  for (const char* file : {"cityscapes", "kitti360", "ade20k"}) {
    const LabelSet labels = LabelSet::load(shipped(file));
    for (const ClassInfo& info : labels.classes()) {
      EXPECT_EQ(info.sky, info.name == "sky") << file << " " << info.name;
    }
    EXPECT_NE(labels.find_name("sky"), nullptr) << file;
  }
}

}  // namespace
}  // namespace facet_mapping
