// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/parameters.h"

#include <algorithm>
#include <iomanip>
#include <map>
#include <numeric>
#include <sstream>

#include <ros/console.h>

namespace facet_mapping {
namespace {

using XmlRpc::XmlRpcValue;

/// Parameters that libraries read from a node's private namespace.
const std::vector<std::string>& library_parameters() {
  static const std::vector<std::string> kNames{"diagnostic_period"};
  return kNames;
}

void flatten(XmlRpcValue& values,
             const std::string& prefix,
             std::map<std::string, XmlRpcValue>* out) {
  for (auto& entry : values) {
    const std::string name = prefix + entry.first;
    if (entry.second.getType() == XmlRpcValue::TypeStruct) {
      flatten(entry.second, name + "/", out);
    } else {
      (*out)[name] = entry.second;
    }
  }
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j + 1] + 1, row[j] + 1});
    }
  }
  return row.back();
}

std::string last_component(const std::string& name) {
  return name.substr(name.rfind('/') + 1);  // npos + 1 == 0
}

std::string markdown_range(const Parameter& parameter) {
  if (std::isinf(parameter.limits.min) && std::isinf(parameter.limits.max)) {
    return parameter.type;
  }
  constexpr int kDigits = 12;  // whole numbers in full
  std::ostringstream text;
  text << std::setprecision(kDigits) << parameter.type << ", ";
  if (std::isinf(parameter.limits.max)) {
    const bool positive = parameter.limits.min > 0.0 && parameter.limits.min <= kSmallestPositive;
    text << (positive ? "above 0" : "at least ");
    if (!positive) {
      text << parameter.limits.min;
    }
  } else {
    text << parameter.limits.min << " to " << parameter.limits.max;
  }
  return text.str();
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 2);
  for (const std::string& candidate : candidates) {
    // The group in front of the last slash is forgotten more often than the name is misspelt.
    const std::size_t distance =
        std::min(edit_distance(name, candidate),
                 edit_distance(last_component(name), last_component(candidate)));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

const Parameter* ParameterTable::find(const std::string& name) const {
  const auto found = std::find_if(parameters_.begin(),
                                  parameters_.end(),
                                  [&name](const Parameter& p) { return p.name == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

std::string ParameterTable::unknown_sentence(const std::string& name) const {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters_) {
    names.push_back(parameter.name);
  }
  const std::string nearest = nearest_name(name, names);
  return "unknown parameter '" + name + "'" +
         (nearest.empty() ? "; see the README for the list" : ": did you mean '" + nearest + "'?");
}

std::vector<std::string> ParameterTable::assign(XmlRpcValue values) const {
  std::vector<std::string> problems;
  std::map<std::string, XmlRpcValue> flat;
  if (values.getType() == XmlRpcValue::TypeStruct) {
    flatten(values, "", &flat);
  }
  for (auto& [name, value] : flat) {
    const auto& extra = library_parameters();
    if (std::find(extra.begin(), extra.end(), name) != extra.end()) {
      continue;
    }
    const Parameter* parameter = find(name);
    const std::string problem =
        parameter == nullptr ? unknown_sentence(name) : parameter->assign(value);
    if (!problem.empty()) {
      problems.push_back(problem);
    }
  }
  for (const auto& check : checks_) {
    const std::string problem = check();
    if (!problem.empty()) {
      problems.push_back(problem);
    }
  }
  return problems;
}

std::string ParameterTable::to_text() const {
  std::ostringstream text;
  for (const Parameter& parameter : parameters_) {
    text << "\n  " << parameter.name << " = " << parameter.text();
    if (!parameter.unit.empty()) {
      text << " " << parameter.unit;
    }
  }
  return text.str();
}

std::string ParameterTable::to_markdown() const {
  std::ostringstream text;
  text << "| parameter | type | default | unit | meaning |\n|---|---|---|---|---|\n";
  for (const Parameter& p : parameters_) {
    text << "| `" << p.name << "` | " << markdown_range(p) << " | `" << p.default_text << "` | "
         << p.unit << " | " << p.help << " |\n";
  }
  return text.str();
}

void load_parameters(const ParameterTable& table, const ros::NodeHandle& private_nh) {
  XmlRpcValue values;
  const bool any = private_nh.getParam(private_nh.getNamespace(), values);
  const std::vector<std::string> problems = table.assign(any ? values : XmlRpcValue());
  if (problems.empty()) {
    return;
  }
  std::string message = private_nh.getNamespace() + ": " + std::to_string(problems.size()) +
                        " problem(s) with the parameters:";
  for (const std::string& problem : problems) {
    message += "\n  - " + problem;
  }
  throw ConfigError(message);
}

}  // namespace facet_mapping
