// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One descriptor table per node feeds the parameter server, the start-up print and the README.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

namespace facet_mapping {

/// The parameters of a node cannot be used; what() lists every problem, one per line.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Stands for "above 0" as a lower limit.
constexpr double kSmallestPositive = 1e-9;

/// Inclusive limits of a number.
struct Limits {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// One parameter: its row in the documentation, and how to read and print its value.
struct Parameter {
  std::string name;  ///< below the node's private namespace: "carving/min_point_spacing_m"
  std::string type;  ///< bool, int, double, string, list of strings, or the choices
  std::string unit;  ///< "" for none
  std::string help;  ///< one sentence
  Limits limits;
  std::string default_text;
  /// Takes a value; returns a sentence if it is refused, "" otherwise.
  std::function<std::string(XmlRpc::XmlRpcValue&)> assign;
  std::function<std::string()> text;  ///< the present value
};

class ParameterTable {
 public:
  void add(const std::string& name, bool* value, const std::string& help);
  void add(const std::string& name,
           int* value,
           const std::string& unit,
           const std::string& help,
           const Limits& limits);
  void add(const std::string& name,
           double* value,
           const std::string& unit,
           const std::string& help,
           const Limits& limits);
  void add(const std::string& name, std::string* value, const std::string& help);
  void add(const std::string& name, std::vector<std::string>* value, const std::string& help);

  /// An enumeration by its names.
  template <typename Enum>
  void add_choice(const std::string& name,
                  Enum* value,
                  const std::vector<std::pair<std::string, Enum>>& choices,
                  const std::string& help);

  /// A condition between parameters: returns a sentence if it does not hold, "" otherwise.
  void add_check(std::function<std::string()> check);

  const std::vector<Parameter>& parameters() const { return parameters_; }

  /// Sets the parameters that stand in the (nested) struct `values`; the others keep their
  /// defaults. Returns all problems: wrong type, out of range, unknown name, failed checks.
  std::vector<std::string> assign(XmlRpc::XmlRpcValue values) const;

  /// "name = value [unit]" lines for the log.
  std::string to_text() const;
  /// The README's table.
  std::string to_markdown() const;

 private:
  void add_parameter(Parameter parameter);
  void add_choice_names(const std::string& name,
                        const std::vector<std::string>& names,
                        std::function<void(std::size_t)> set,
                        std::function<std::size_t()> get,
                        const std::string& help);
  const Parameter* find(const std::string& name) const;
  std::string unknown_sentence(const std::string& name) const;

  std::vector<Parameter> parameters_;
  std::vector<std::function<std::string()>> checks_;
};

/// Reads the node's private parameters. Throws ConfigError with all problems at once.
void load_parameters(const ParameterTable& table, const ros::NodeHandle& private_nh);

/// The candidate with the least edit distance to `name`; "" if none is near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

template <typename Enum>
void ParameterTable::add_choice(const std::string& name,
                                Enum* value,
                                const std::vector<std::pair<std::string, Enum>>& choices,
                                const std::string& help) {
  std::vector<std::string> names;
  for (const auto& choice : choices) {
    names.push_back(choice.first);
  }
  const auto get = [value, choices] {
    std::size_t k = 0;
    while (k + 1 < choices.size() && choices[k].second != *value) {
      ++k;
    }
    return k;
  };
  add_choice_names(
      name, names, [value, choices](std::size_t k) { *value = choices[k].second; }, get, help);
}

}  // namespace facet_mapping
