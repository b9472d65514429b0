// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Real data for tests, where the machine has it: FACET_MAPPING_DATA, or ../shared/data beside the
// checkout.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace facet_mapping::testing {

/// The folder of a data set, empty where it is not there.
inline std::string shared_data(const std::string& name) {
  const char* root = std::getenv("FACET_MAPPING_DATA");
  const std::filesystem::path folder =
      root != nullptr ? std::filesystem::path(root)
                      : std::filesystem::path(FACET_MAPPING_SOURCE_DIR) / "../shared/data";
  std::error_code error;
  return std::filesystem::is_directory(folder / name, error) ? (folder / name).string() : "";
}

}  // namespace facet_mapping::testing

/// Defines `variable` as the folder of a data set or skips the test with a reason.
#define FACET_MAPPING_DATA_OR_SKIP(variable, name)                                      \
  const std::string variable = ::facet_mapping::testing::shared_data(name);             \
  if ((variable).empty()) {                                                             \
    GTEST_SKIP() << "the data set " << (name)                                           \
                 << " is not here: set FACET_MAPPING_DATA to the folder that holds it"; \
  }                                                                                     \
  static_assert(true, "")
