// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What every command-line program does around its work.
#pragma once

#include <exception>
#include <iostream>

#include <CLI/CLI.hpp>

namespace facet_mapping {

/// Parses the command line and runs the work. Returns the exit code; an error is one sentence on
/// standard error.
template <typename Function>
int run_tool(CLI::App& app, int argc, char** argv, const Function& work) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  try {
    work();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << error.what() << std::endl;
    return 1;
  }
}

}  // namespace facet_mapping
