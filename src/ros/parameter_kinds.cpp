// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How each kind of parameter is read from the server and printed.
#include <cmath>
#include <sstream>

#include "facet_mapping/ros/parameters.h"

namespace facet_mapping {
namespace {

using XmlRpc::XmlRpcValue;

std::string number_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string list_text(const std::vector<std::string>& values) {
  std::string text = "[";
  for (const std::string& value : values) {
    text += (text.size() > 1 ? ", " : "") + value;
  }
  return text + "]";
}

std::string value_text(XmlRpcValue& value) {
  std::ostringstream text;
  value.write(text);
  return text.str();
}

std::string type_problem(const std::string& name, XmlRpcValue& value, const std::string& expected) {
  return "'" + name + "' is " + value_text(value) + "; expected " + expected;
}

bool is_number(const XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeInt || value.getType() == XmlRpcValue::TypeDouble;
}

double to_number(XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeInt ? static_cast<int>(value)
                                                 : static_cast<double>(value);
}

/// "" if `number` lies inside the limits.
std::string range_problem(const std::string& name, double number, const Limits& limits) {
  if (std::isfinite(number) && number >= limits.min && number <= limits.max) {
    return "";
  }
  return "'" + name + "' is " + number_text(number) + "; allowed are " + number_text(limits.min) +
         " to " + number_text(limits.max);
}

}  // namespace

void ParameterTable::add_parameter(Parameter parameter) {
  parameter.default_text = parameter.text();
  parameters_.push_back(std::move(parameter));
}

void ParameterTable::add_check(std::function<std::string()> check) {
  checks_.push_back(std::move(check));
}

void ParameterTable::add(const std::string& name, bool* value, const std::string& help) {
  const auto assign = [name, value](XmlRpcValue& given) -> std::string {
    if (given.getType() != XmlRpcValue::TypeBoolean) {
      return type_problem(name, given, "true or false");
    }
    *value = static_cast<bool>(given);
    return "";
  };
  add_parameter({name, "bool", "", help, {}, "", assign, [value] {
                   return std::string(*value ? "true" : "false");
                 }});
}

void ParameterTable::add(const std::string& name,
                         int* value,
                         const std::string& unit,
                         const std::string& help,
                         const Limits& limits) {
  const auto assign = [name, value, limits](XmlRpcValue& given) -> std::string {
    if (!is_number(given) || to_number(given) != std::floor(to_number(given))) {
      return type_problem(name, given, "a whole number");
    }
    const std::string problem = range_problem(name, to_number(given), limits);
    if (problem.empty()) {
      *value = static_cast<int>(to_number(given));
    }
    return problem;
  };
  add_parameter(
      {name, "int", unit, help, limits, "", assign, [value] { return std::to_string(*value); }});
}

void ParameterTable::add(const std::string& name,
                         double* value,
                         const std::string& unit,
                         const std::string& help,
                         const Limits& limits) {
  const auto assign = [name, value, limits](XmlRpcValue& given) -> std::string {
    if (!is_number(given)) {
      return type_problem(name, given, "a number");
    }
    const std::string problem = range_problem(name, to_number(given), limits);
    if (problem.empty()) {
      *value = to_number(given);
    }
    return problem;
  };
  add_parameter(
      {name, "double", unit, help, limits, "", assign, [value] { return number_text(*value); }});
}

void ParameterTable::add(const std::string& name, std::string* value, const std::string& help) {
  const auto assign = [name, value](XmlRpcValue& given) -> std::string {
    if (given.getType() != XmlRpcValue::TypeString) {
      return type_problem(name, given, "a text");
    }
    *value = static_cast<std::string>(given);
    return "";
  };
  add_parameter({name, "string", "", help, {}, "", assign, [value] { return *value; }});
}

void ParameterTable::add(const std::string& name,
                         std::vector<std::string>* value,
                         const std::string& help) {
  const auto assign = [name, value](XmlRpcValue& given) -> std::string {
    std::vector<std::string> texts;
    const bool is_list = given.getType() == XmlRpcValue::TypeArray;
    for (int k = 0; is_list && k < given.size(); ++k) {
      if (given[k].getType() == XmlRpcValue::TypeString) {
        texts.push_back(static_cast<std::string>(given[k]));
      }
    }
    if (!is_list || texts.size() != static_cast<std::size_t>(given.size())) {
      return type_problem(name, given, "a list of texts, e.g. [a, b]");
    }
    *value = texts;
    return "";
  };
  add_parameter({name, "list", "", help, {}, "", assign, [value] { return list_text(*value); }});
}

void ParameterTable::add_choice_names(const std::string& name,
                                      const std::vector<std::string>& names,
                                      std::function<void(std::size_t)> set,
                                      std::function<std::size_t()> get,
                                      const std::string& help) {
  std::string choices;
  for (const std::string& choice : names) {
    choices += (choices.empty() ? "" : ", ") + choice;
  }
  const auto assign = [name, names, choices, set = std::move(set)](XmlRpcValue& given) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (given.getType() == XmlRpcValue::TypeString &&
          static_cast<std::string>(given) == names[k]) {
        set(k);
        return std::string();
      }
    }
    // YAML reads a bare `off` as false.
    return type_problem(name, given, "one of: " + choices + " (in quotes)");
  };
  add_parameter({name, choices, "", help, {}, "", assign, [names, get = std::move(get)] {
                   return names[get()];
                 }});
}

}  // namespace facet_mapping
