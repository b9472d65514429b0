// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading of YAML label files; every problem of a file is collected before anything is thrown.
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "label_checks.h"
#include <yaml-cpp/yaml.h>

#include "facet_mapping/labels/label_set.h"

namespace facet_mapping {
namespace {

using detail::ClassChecker;

constexpr char kClassKeys[] = "id, name, color, dynamic, ignore, planar, sky, aliases";

std::string line_of(const YAML::Mark& mark) {
  return mark.is_null() ? "unknown line" : "line " + std::to_string(mark.line + 1);
}

std::string line_of(const YAML::Node& node) {
  return line_of(node.Mark());
}

template <typename T>
std::optional<T> read_scalar(const YAML::Node& node,
                             const std::string& what,
                             const std::string& expected,
                             ClassChecker& checker) {
  T value{};
  if (node.IsScalar() && YAML::convert<T>::decode(node, value)) {
    return value;
  }
  checker.add(line_of(node) + ": " + what + " must be " + expected);
  return std::nullopt;
}

std::optional<int> read_int(const YAML::Node& node,
                            const std::string& what,
                            int largest,
                            ClassChecker& checker) {
  const std::string expected = "a whole number from 0 to " + std::to_string(largest);
  const std::optional<int> value = read_scalar<int>(node, what, expected, checker);
  if (value && (*value < 0 || *value > largest)) {
    checker.add(line_of(node) + ": " + what + " is " + std::to_string(*value) + " but must be " +
                expected);
    return std::nullopt;
  }
  return value;
}

/// Reads and checks one colour; anything but three channels of 0..255 is a problem.
Rgb read_color(const YAML::Node& node, const std::string& what, ClassChecker& checker) {
  Rgb color{};
  if (!node.IsSequence() || node.size() != color.size()) {
    checker.add(line_of(node) + ": " + what + " must be [red, green, blue]");
    return color;
  }
  bool complete = true;
  for (std::size_t i = 0; i < color.size(); ++i) {
    const std::optional<int> channel = read_int(node[i], what + " channel", 255, checker);
    color[i] = static_cast<std::uint8_t>(channel.value_or(0));
    complete = complete && channel.has_value();
  }
  if (complete) {
    checker.check_color(color, line_of(node));
  }
  return color;
}

std::vector<Rgb> read_aliases(const YAML::Node& node, ClassChecker& checker) {
  std::vector<Rgb> aliases;
  if (!node.IsSequence()) {
    checker.add(line_of(node) + ": aliases must be a list of [red, green, blue]");
    return aliases;
  }
  for (const YAML::Node& alias : node) {
    aliases.push_back(read_color(alias, "alias", checker));
  }
  return aliases;
}

Label read_id(const YAML::Node& node, ClassChecker& checker) {
  const std::optional<int> id = read_int(node, "id", kUnlabelled, checker);
  if (id) {
    checker.check_id(static_cast<Label>(*id), line_of(node));
  }
  return static_cast<Label>(id.value_or(0));
}

std::string read_name(const YAML::Node& node, ClassChecker& checker) {
  const std::optional<std::string> name = read_scalar<std::string>(node, "name", "a text", checker);
  if (name) {
    checker.check_name(*name, line_of(node));
  }
  return name.value_or("");
}

bool ClassInfo::*find_flag(const std::string& key) {
  if (key == "dynamic") {
    return &ClassInfo::dynamic;
  }
  if (key == "ignore") {
    return &ClassInfo::ignore;
  }
  if (key == "planar") {
    return &ClassInfo::planar;
  }
  return key == "sky" ? &ClassInfo::sky : nullptr;
}

void add_unknown_key(const YAML::Node& key, const std::string& known, ClassChecker& checker) {
  const std::string text = key.IsScalar() ? "'" + key.Scalar() + "'" : "that is no word";
  checker.add(line_of(key) + ": unknown key " + text + "; known are " + known);
}

void read_field(const YAML::Node& key_node,
                const YAML::Node& value,
                ClassInfo& info,
                ClassChecker& checker) {
  const std::string key = key_node.IsScalar() ? key_node.Scalar() : "";
  if (key == "id") {
    info.id = read_id(value, checker);
  } else if (key == "name") {
    info.name = read_name(value, checker);
  } else if (key == "color") {
    info.color = read_color(value, "color", checker);
  } else if (key == "aliases") {
    info.aliases = read_aliases(value, checker);
  } else if (bool ClassInfo::*const flag = find_flag(key)) {
    info.*flag = read_scalar<bool>(value, key, "true or false", checker).value_or(false);
  } else {
    add_unknown_key(key_node, kClassKeys, checker);
  }
}

/// Hands each key of a map to `read` once; a key that stands twice is a problem.
template <typename Read>
std::set<std::string> read_map(const YAML::Node& node, ClassChecker& checker, const Read& read) {
  std::set<std::string> keys;
  for (const auto& entry : node) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (keys.insert(key).second) {
      read(entry.first, entry.second);
    } else {
      checker.add(line_of(entry.first) + ": the key '" + key + "' stands twice");
    }
  }
  return keys;
}

ClassInfo read_class(const YAML::Node& node, ClassChecker& checker) {
  ClassInfo info;
  if (!node.IsMap()) {
    checker.add(line_of(node) + ": a class must be a map of " + kClassKeys);
    return info;
  }
  const std::set<std::string> keys =
      read_map(node, checker, [&](const YAML::Node& key, const YAML::Node& value) {
        read_field(key, value, info, checker);
      });
  for (const char* required : {"id", "name", "color"}) {
    if (keys.count(required) == 0) {
      checker.add(line_of(node) + ": the class has no " + required);
    }
  }
  return info;
}

std::vector<ClassInfo> read_classes(const YAML::Node& node, ClassChecker& checker) {
  std::vector<ClassInfo> classes;
  if (!node.IsSequence() || node.size() == 0) {
    checker.add(line_of(node) + ": 'classes' must be a list of at least one class");
    return classes;
  }
  for (const YAML::Node& entry : node) {
    classes.push_back(read_class(entry, checker));
  }
  return classes;
}

std::vector<ClassInfo> read_root(const YAML::Node& root, ClassChecker& checker) {
  std::vector<ClassInfo> classes;
  if (!root.IsMap()) {
    checker.add("the file must hold a map with the one key 'classes'");
    return classes;
  }
  const std::set<std::string> keys =
      read_map(root, checker, [&](const YAML::Node& key, const YAML::Node& value) {
        if (key.IsScalar() && key.Scalar() == "classes") {
          classes = read_classes(value, checker);
        } else {
          add_unknown_key(key, "classes", checker);
        }
      });
  if (keys.count("classes") == 0) {
    checker.add("the key 'classes' is missing");
  }
  return classes;
}

std::vector<ClassInfo> read_file(const std::string& path, ClassChecker& checker) {
  std::error_code not_needed;
  std::ifstream stream(path);
  if (!std::filesystem::is_regular_file(path, not_needed) || !stream) {
    checker.add("there is no such file, or it cannot be read");
    return {};
  }
  try {
    return read_root(YAML::Load(stream), checker);
  } catch (const YAML::Exception& error) {
    checker.add(line_of(error.mark) + ": not valid YAML: " + error.msg);
    return {};
  }
}

}  // namespace

LabelSet LabelSet::load(const std::string& path) {
  ClassChecker checker;
  std::vector<ClassInfo> classes = read_file(path, checker);
  if (!checker.problems().empty()) {
    throw std::invalid_argument(
        detail::join_problems("The label file '" + path + "' is not usable", checker.problems()));
  }
  return LabelSet(std::move(classes));
}

}  // namespace facet_mapping
