// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// custom.launch as a child process, started with given arguments in the master of the test.
#pragma once

#include <csignal>
#include <string>
#include <vector>

#include <sys/types.h>

namespace facet_mapping::test {

class LaunchedChain {
 public:
  explicit LaunchedChain(const std::vector<std::string>& arguments);
  /// Ends all nodes and waits for them.
  ~LaunchedChain();
  LaunchedChain(const LaunchedChain&) = delete;
  LaunchedChain& operator=(const LaunchedChain&) = delete;

  /// False once roslaunch has ended by itself.
  bool is_running();

 private:
  pid_t pid_ = -1;
};

}  // namespace facet_mapping::test
