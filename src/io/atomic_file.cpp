// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/io/atomic_file.h"

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace facet_mapping {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what, int code) {
  throw std::runtime_error(what + ": " + std::generic_category().message(code));
}

void make_parent(const fs::path& path) {
  std::error_code error;
  if (path.has_parent_path()) {
    fs::create_directories(path.parent_path(), error);
  }
  if (error) {
    fail("cannot make the folder '" + path.parent_path().string() + "'", error.value());
  }
}

// The directory entry is what makes the new name last through a power cut.
void sync_folder_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    ::fsync(descriptor);
    ::close(descriptor);
  }
}

}  // namespace

std::string temporary_beside(const std::string& path) {
  if (path.empty()) {
    throw std::runtime_error("cannot write a file without a name: give a path");
  }
  std::error_code error;
  if (fs::is_directory(path, error)) {
    throw std::runtime_error("cannot write '" + path + "': it is a folder, give a file name");
  }
  make_parent(path);
  std::string name = path + ".part" + std::to_string(::getpid());
  for (int k = 0; fs::exists(name, error); ++k) {
    name = path + ".part" + std::to_string(::getpid()) + "_" + std::to_string(k);
  }
  return name;
}

void publish_file(const std::string& temporary, const std::string& path) {
  const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  int code = descriptor < 0 ? errno : 0;
  if (code == 0 && ::fsync(descriptor) != 0) {
    code = errno;
  }
  if (descriptor >= 0) {
    ::close(descriptor);
  }
  if (code == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) {
    code = errno;
  }
  if (code != 0) {
    ::unlink(temporary.c_str());
    fail("cannot write '" + path + "'", code);
  }
  sync_folder_of(path);
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), temporary_(temporary_beside(path)) {
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    fail("cannot write '" + path_ + "'", errno);
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
  }
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = ::write(descriptor_, next, bytes);
    if (written < 0 && errno != EINTR) {
      fail("cannot write '" + path_ + "'", errno);
    }
    if (written > 0) {
      next += written;
      bytes -= static_cast<std::size_t>(written);
    }
  }
}

void AtomicFile::commit() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) {
    const int code = errno;
    ::unlink(temporary_.c_str());
    fail("cannot write '" + path_ + "'", code);
  }
  publish_file(temporary_, path_);
}

}  // namespace facet_mapping
