// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/labels/label_set.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "label_checks.h"

namespace facet_mapping {
namespace {

bool has_color(const ClassInfo& info, const Rgb& color) {
  return info.color == color ||
         std::find(info.aliases.begin(), info.aliases.end(), color) != info.aliases.end();
}

template <typename Predicate>
const ClassInfo* find_class(const std::vector<ClassInfo>& classes, const Predicate& matches) {
  const auto found = std::find_if(classes.begin(), classes.end(), matches);
  return found == classes.end() ? nullptr : &*found;
}

void check_class(const ClassInfo& info, const std::string& place, detail::ClassChecker& checker) {
  checker.check_id(info.id, place);
  checker.check_name(info.name, place);
  checker.check_color(info.color, place);
  for (const Rgb& alias : info.aliases) {
    checker.check_color(alias, place);
  }
}

}  // namespace

LabelSet::LabelSet(std::vector<ClassInfo> classes) : classes_(std::move(classes)) {
  detail::ClassChecker checker;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    check_class(classes_[i], "class number " + std::to_string(i + 1), checker);
  }
  if (!checker.problems().empty()) {
    throw std::invalid_argument(
        detail::join_problems("The class list is not usable", checker.problems()));
  }
  std::sort(classes_.begin(), classes_.end(), [](const ClassInfo& a, const ClassInfo& b) {
    return a.id < b.id;
  });
}

const ClassInfo* LabelSet::find(Label id) const {
  const auto found = std::lower_bound(
      classes_.begin(), classes_.end(), id, [](const ClassInfo& info, Label wanted) {
        return info.id < wanted;
      });
  return found == classes_.end() || found->id != id ? nullptr : &*found;
}

const ClassInfo* LabelSet::find_name(const std::string& name) const {
  return find_class(classes_, [&name](const ClassInfo& info) { return info.name == name; });
}

const ClassInfo* LabelSet::find_color(const Rgb& color) const {
  return find_class(classes_, [&color](const ClassInfo& info) { return has_color(info, color); });
}

std::vector<Label> LabelSet::sky_ids() const {
  std::vector<Label> ids;
  for (const ClassInfo& info : classes_) {
    if (info.sky) {
      ids.push_back(info.id);
    }
  }
  return ids;
}

std::string LabelSet::name_of(Label id) const {
  if (const ClassInfo* info = find(id)) {
    return info->name;
  }
  return id == kUnlabelled ? "unlabelled" : "class " + std::to_string(id);
}

Rgb LabelSet::color_of(Label id) const {
  const ClassInfo* info = find(id);
  return info == nullptr ? kUnlabelledColor : info->color;
}

}  // namespace facet_mapping
