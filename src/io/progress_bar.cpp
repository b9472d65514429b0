// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/io/progress_bar.h"

#include <iostream>
#include <utility>

#include <unistd.h>

namespace facet_mapping {
namespace {

int step_of(std::size_t done, std::size_t total, int steps) {
  return total == 0 ? steps : static_cast<int>(static_cast<std::size_t>(steps) * done / total);
}

}  // namespace

bool stderr_is_terminal() {
  return ::isatty(STDERR_FILENO) == 1;
}

ProgressBar::ProgressBar(std::ostream& output, std::string title, bool on_terminal)
    : output_(output), title_(std::move(title)), on_terminal_(on_terminal) {}

ProgressBar::ProgressBar(std::string title)
    : ProgressBar(std::cerr, std::move(title), stderr_is_terminal()) {}

void ProgressBar::update(std::size_t done, std::size_t total) {
  if (on_terminal_) {
    draw_bar(done, total);
  } else {
    write_line(done, total);
  }
}

void ProgressBar::draw_bar(std::size_t done, std::size_t total) {
  constexpr int kPermille = 1000;
  constexpr std::size_t kWidth = 30;
  const int step = step_of(done, total, kPermille);
  if (step == last_step_) {
    return;
  }
  last_step_ = step;
  const auto filled = static_cast<std::size_t>(step_of(done, total, kWidth));
  output_ << "\r" << title_ << " [" << std::string(filled, '#') << std::string(kWidth - filled, ' ')
          << "] " << done << "/" << total << (done == total ? "\n" : "") << std::flush;
}

void ProgressBar::write_line(std::size_t done, std::size_t total) {
  constexpr int kTenths = 10;
  const int step = step_of(done, total, kTenths);
  if (step == last_step_) {
    return;
  }
  last_step_ = step;
  output_ << title_ << ": " << step_of(done, total, 100) << " % (" << done << " of " << total
          << ")\n"
          << std::flush;
}

}  // namespace facet_mapping
