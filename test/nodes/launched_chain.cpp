// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "launched_chain.h"

#include <cstdlib>

#include <sys/wait.h>
#include <unistd.h>

namespace facet_mapping::test {

LaunchedChain::LaunchedChain(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"roslaunch", "facet_mapping", "custom.launch"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    execvp(argv[0], argv.data());
    std::_Exit(127);
  }
}

LaunchedChain::~LaunchedChain() {
  if (is_running()) {
    kill(pid_, SIGINT);
    waitpid(pid_, nullptr, 0);
  }
}

bool LaunchedChain::is_running() {
  if (pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == pid_) {
    pid_ = -1;
  }
  return pid_ > 0;
}

}  // namespace facet_mapping::test
