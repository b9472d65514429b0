// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of long steps for command-line programs.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>

namespace facet_mapping {

/// True if people watch standard error rather than a file or a pipe.
bool stderr_is_terminal();

/// On a terminal a bar that redraws itself, elsewhere a plain line at every tenth of the way.
class ProgressBar {
 public:
  ProgressBar(std::ostream& output, std::string title, bool on_terminal);

  /// A bar on standard error.
  explicit ProgressBar(std::string title);

  /// Calls may come as often as one likes: only changes are written.
  void update(std::size_t done, std::size_t total);

 private:
  void draw_bar(std::size_t done, std::size_t total);
  void write_line(std::size_t done, std::size_t total);

  std::ostream& output_;
  std::string title_;
  bool on_terminal_;
  int last_step_ = -1;
};

}  // namespace facet_mapping
