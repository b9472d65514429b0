// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Dataset folders with one thing broken, and what read_dataset must say about it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/temp_folder.h"
#include <gtest/gtest.h>

#include "facet_mapping/io/dataset.h"

namespace facet_mapping::testing {

using Damage = std::function<void(const std::string& folder)>;

struct Case {
  Damage damage;
  std::vector<std::string> expected;  ///< parts of the message; none: it is no damage
};

/// These make the damage.
inline Damage remove_file(const std::string& name) {
  return [name](const std::string& folder) { std::filesystem::remove_all(folder + "/" + name); };
}

inline Damage write_file(const std::string& name, const std::string& text) {
  return [name, text](const std::string& folder) { write_text(folder + "/" + name, text); };
}

inline Damage replace(const std::string& name,
                      const std::string& old_text,
                      const std::string& new_text) {
  return [=](const std::string& folder) {
    std::string text = read_text(folder + "/" + name);
    const std::size_t at = text.find(old_text);
    ASSERT_NE(at, std::string::npos) << old_text;
    write_text(folder + "/" + name, text.replace(at, old_text.size(), new_text));
  };
}

/// Makes a dataset below the parent and returns its folder.
using Maker = std::function<std::string(const std::string& parent)>;

/// A folder made anew for each case is read without error, and with the expected one after
/// the damage.
inline void check(const Maker& make, const std::vector<Case>& cases) {
  for (const Case& damaged : cases) {
    const TempFolder parent;
    const std::string folder = make(parent / "set");
    ASSERT_EQ(error_of([&] { read_dataset(folder); }), "");
    damaged.damage(folder);
    const std::string error = error_of([&] { read_dataset(folder); });
    EXPECT_EQ(error.empty(), damaged.expected.empty()) << error;
    EXPECT_TRUE(error.empty() || error.find(folder) != std::string::npos) << error;
    for (const std::string& part : damaged.expected) {
      EXPECT_NE(error.find(part), std::string::npos) << part << " / " << error;
    }
  }
}

}  // namespace facet_mapping::testing
