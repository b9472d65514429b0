// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/parameters.h"

#include <filesystem>
#include <map>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "facet_mapping/ros/lidar_points_node_config.h"
#include "facet_mapping/ros/mesh_server_node_config.h"
#include "facet_mapping/ros/node_config.h"

namespace facet_mapping {
namespace {

enum class Fruit { kApple, kPear };

struct Config {
  bool flag = false;
  int count = 3;
  double length = 1.5;
  std::string name = "x";
  std::vector<std::string> topics{"points"};
  Fruit fruit = Fruit::kApple;
};

ParameterTable table_of(Config* config) {
  ParameterTable table;
  table.add("flag", &config->flag, "a flag");
  table.add("group/count", &config->count, "px", "a count", {1, 10});
  table.add("length_m", &config->length, "m", "a length", {0.0, 100.0});
  table.add("name", &config->name, "a name");
  table.add("topics", &config->topics, "topics");
  table.add_choice<Fruit>(
      "fruit", &config->fruit, {{"apple", Fruit::kApple}, {"pear", Fruit::kPear}}, "a fruit");
  table.add_check([config]() -> std::string { return config->count == 7 ? "not seven" : ""; });
  return table;
}

XmlRpc::XmlRpcValue values_of(const YAML::Node& node) {
  XmlRpc::XmlRpcValue value;
  if (node.IsMap()) {
    for (const auto& entry : node) {
      value[entry.first.as<std::string>()] = values_of(entry.second);
    }
  } else if (node.IsSequence()) {
    value.setSize(static_cast<int>(node.size()));
    for (std::size_t k = 0; k < node.size(); ++k) {
      value[static_cast<int>(k)] = values_of(node[k]);
    }
  } else if (int whole = 0; YAML::convert<int>::decode(node, whole)) {
    value = whole;
  } else if (double number = 0.0; YAML::convert<double>::decode(node, number)) {
    value = number;
  } else if (bool flag = false; node.Tag() != "!" && YAML::convert<bool>::decode(node, flag)) {
    value = flag;
  } else {
    value = node.as<std::string>();
  }
  return value;
}

std::vector<std::string> assign(const ParameterTable& table, const std::string& yaml) {
  return table.assign(values_of(YAML::Load(yaml)));
}

TEST(Parameters, EveryKindIsRead) {
  Config config;
  const auto problems = assign(table_of(&config),
                               "{flag: true, group: {count: 5}, length_m: 2, name: hello, "
                               "topics: [a, b], fruit: pear}");
  EXPECT_TRUE(problems.empty());
  EXPECT_TRUE(config.flag);
  EXPECT_EQ(config.count, 5);
  EXPECT_DOUBLE_EQ(config.length, 2.0);
  EXPECT_EQ(config.name, "hello");
  EXPECT_EQ(config.topics, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(config.fruit, Fruit::kPear);
}

TEST(Parameters, WhatIsMissingKeepsItsDefault) {
  Config config;
  EXPECT_TRUE(table_of(&config).assign(XmlRpc::XmlRpcValue()).empty());
  EXPECT_EQ(config.count, 3);
  EXPECT_EQ(config.name, "x");
}

TEST(Parameters, AllProblemsAreReportedAtOnce) {
  Config config;
  const auto problems = assign(table_of(&config),
                               "{flag: 3, group: {count: 11}, length_m: -1.0, fruit: plum, "
                               "topics: 4, name: 5}");
  EXPECT_EQ(problems.size(), 6U);
  EXPECT_EQ(config.count, 3);  // what is refused changes nothing
}

TEST(Parameters, ChecksBetweenParametersAreRun) {
  Config config;
  EXPECT_EQ(assign(table_of(&config), "{group: {count: 7}}"),
            std::vector<std::string>{"not seven"});
}

TEST(Parameters, MisspeltNameIsAnErrorWithTheNearest) {
  Config config;
  const auto problems = assign(table_of(&config), "{lenght_m: 2.0}");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("did you mean 'length_m'"), std::string::npos) << problems[0];
}

TEST(Parameters, ForgottenGroupIsSuggested) {
  Config config;
  const auto problems = assign(table_of(&config), "{count: 2}");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("did you mean 'group/count'"), std::string::npos) << problems[0];
}

TEST(Parameters, LibraryParametersAreLeftAlone) {
  Config config;
  EXPECT_TRUE(assign(table_of(&config), "{diagnostic_period: 0.2}").empty());
}

TEST(Parameters, FractionIsNoWholeNumber) {
  Config config;
  EXPECT_EQ(assign(table_of(&config), "{group: {count: 2.5}}").size(), 1U);
}

TEST(Parameters, DocumentationHoldsDefaultsNotValues) {
  Config config;
  const ParameterTable table = table_of(&config);
  ASSERT_TRUE(assign(table, "{group: {count: 5}}").empty());
  EXPECT_NE(table.to_markdown().find("| `group/count` | int, 1 to 10 | `3` | px |"),
            std::string::npos)
      << table.to_markdown();
  EXPECT_NE(table.to_text().find("group/count = 5 px"), std::string::npos) << table.to_text();
}

template <typename NodeConfig>
void expect_every_default_in_range() {
  NodeConfig config;
  const ParameterTable table = parameter_table(&config);
  EXPECT_TRUE(table.assign(XmlRpc::XmlRpcValue()).empty());
  for (const Parameter& parameter : table.parameters()) {
    EXPECT_FALSE(parameter.help.empty()) << parameter.name;
    if (parameter.type == "int" || parameter.type == "double") {
      const double value = std::stod(parameter.default_text);
      EXPECT_GE(value, parameter.limits.min) << parameter.name;
      EXPECT_LE(value, parameter.limits.max) << parameter.name;
    }
  }
}

TEST(NodeParameters, DefaultsAreValid) {
  expect_every_default_in_range<StereoPointsNodeConfig>();
  expect_every_default_in_range<TrackPointsNodeConfig>();
  expect_every_default_in_range<SweepPointsNodeConfig>();
  expect_every_default_in_range<LidarPointsNodeConfig>();
  expect_every_default_in_range<MapperNodeConfig>();
  expect_every_default_in_range<RefinerNodeConfig>();
  expect_every_default_in_range<MeshServerNodeConfig>();
}

std::string config_folder() {
  return std::string(FACET_MAPPING_SOURCE_DIR) + "/config/";
}

template <typename NodeConfig>
std::string assign_node(const YAML::Node& values) {
  NodeConfig config;
  std::string text;
  for (const std::string& problem : parameter_table(&config).assign(values_of(values))) {
    text += problem + "\n";
  }
  return text;
}

template <typename NodeConfig>
void expect_defaults(const std::string& file) {
  NodeConfig config;
  const ParameterTable table = parameter_table(&config);
  const std::string defaults = table.to_text();
  EXPECT_TRUE(table.assign(values_of(YAML::LoadFile(config_folder() + file))).empty());
  EXPECT_EQ(table.to_text(), defaults) << file;
}

TEST(NodeParameters, ShippedFilesStateTheDefaults) {
  expect_defaults<StereoPointsNodeConfig>("stereo_points.yaml");
  expect_defaults<TrackPointsNodeConfig>("track_points.yaml");
  expect_defaults<SweepPointsNodeConfig>("sweep_points.yaml");
  expect_defaults<LidarPointsNodeConfig>("lidar_points.yaml");
  expect_defaults<MapperNodeConfig>("mapper.yaml");
  expect_defaults<RefinerNodeConfig>("refiner.yaml");
  expect_defaults<MeshServerNodeConfig>("mesh_server.yaml");
}

TEST(NodeParameters, DatasetOverlaysAreAccepted) {
  const std::map<std::string, std::string (*)(const YAML::Node&)> nodes{
      {"stereo_points", assign_node<StereoPointsNodeConfig>},
      {"track_points", assign_node<TrackPointsNodeConfig>},
      {"sweep_points", assign_node<SweepPointsNodeConfig>},
      {"lidar_points", assign_node<LidarPointsNodeConfig>},
      {"mapper", assign_node<MapperNodeConfig>},
      {"refiner", assign_node<RefinerNodeConfig>}};
  for (const auto& entry : std::filesystem::directory_iterator(config_folder() + "datasets")) {
    for (const auto& node : YAML::LoadFile(entry.path().string())) {
      const auto found = nodes.find(node.first.as<std::string>());
      ASSERT_NE(found, nodes.end()) << entry.path() << ": no such node: " << node.first;
      EXPECT_EQ(found->second(node.second), "") << entry.path();
    }
  }
}

TEST(NearestName, NothingNearGivesNothing) {
  EXPECT_EQ(nearest_name("qwertz", {"length_m", "flag"}), "");
}

}  // namespace
}  // namespace facet_mapping
