// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mapping/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

constexpr char kPrefix[] = "facet_mapping_archive_";
constexpr char kLockName[] = "in_use";

[[noreturn]] void fail(const std::string& what, int code) {
  throw std::runtime_error(what + ": " + std::generic_category().message(code));
}

int open_lock(const fs::path& folder, int flags) {
  // The system frees the lock however the process ends.
  const int lock = ::open((folder / kLockName).c_str(), flags | O_RDWR | O_CLOEXEC, 0600);
  if (lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock);
    return -1;
  }
  return lock;
}

}  // namespace

std::string make_scratch_folder(const std::string& parent, int* lock) {
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) {
    fail("cannot make the folder '" + parent + "'", error.value());
  }
  std::string name = (fs::path(parent) / (std::string(kPrefix) + "XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) {
    fail("cannot make a folder in '" + parent + "'", errno);
  }
  *lock = open_lock(name, O_CREAT);
  if (*lock < 0) {
    const int code = errno;
    fs::remove_all(name, error);
    fail("cannot write into '" + name + "'", code);
  }
  return name;
}

void remove_abandoned_folders(const std::string& parent) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(parent, error)) {
    if (entry.path().filename().string().rfind(kPrefix, 0) != 0) {
      continue;
    }
    const int lock = open_lock(entry.path(), 0);
    if (lock >= 0) {  // nobody holds it
      fs::remove_all(entry.path(), error);
      ::close(lock);
    }
  }
}

void remove_scratch_folder(const std::string& folder, int* lock) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (*lock >= 0) {
    ::close(*lock);
    *lock = -1;
  }
}

}  // namespace facet_mapping
