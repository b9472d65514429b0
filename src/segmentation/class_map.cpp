// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "facet_mapping/segmentation/network_segmenter.h"

namespace facet_mapping {
namespace {

std::vector<Label> default_class_map(const LabelSet& labels) {
  std::vector<Label> map;
  for (const ClassInfo& info : labels.classes()) {
    if (!info.ignore) {
      map.push_back(info.id);
    }
  }
  return map;
}

std::runtime_error problem(const std::string& path, const std::string& sentence) {
  return std::runtime_error("The class map '" + path + "' " + sentence);
}

Label read_entry(const YAML::Node& node,
                 std::size_t channel,
                 const std::string& path,
                 const LabelSet& labels) {
  if (node.IsScalar() && node.Scalar() == "none") {
    return kUnlabelled;
  }
  int id = -1;
  if (!node.IsScalar() || !YAML::convert<int>::decode(node, id)) {
    throw problem(
        path,
        "has no class id for channel " + std::to_string(channel) + "; write a number or none");
  }
  const bool known = id >= 0 && id < kUnlabelled && labels.find(static_cast<Label>(id)) != nullptr;
  if (!known) {
    throw problem(path,
                  "gives channel " + std::to_string(channel) + " the id " + std::to_string(id) +
                      ", which the label list does not have; write one of its ids or none");
  }
  return static_cast<Label>(id);
}

YAML::Node load_yaml(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) {
    throw problem(path, "cannot be read: there is no such file, or no permission");
  }
  try {
    return YAML::Load(stream);
  } catch (const YAML::Exception& error) {
    throw problem(path, std::string("is not valid YAML: ") + error.what());
  }
}

}  // namespace

std::vector<Label> read_class_map(const std::string& path, const LabelSet& labels) {
  if (path.empty()) {
    return default_class_map(labels);
  }
  const YAML::Node root = load_yaml(path);
  const YAML::Node classes = root.IsMap() ? root["classes"] : YAML::Node();
  if (!classes.IsSequence() || classes.size() == 0) {
    throw problem(path, "must hold the key 'classes' with a list of class ids, one per channel");
  }
  std::vector<Label> map;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    map.push_back(read_entry(classes[k], k, path, labels));
  }
  return map;
}

}  // namespace facet_mapping
