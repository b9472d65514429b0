// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Files that appear under their name only when they are complete.
#pragma once

#include <cstddef>
#include <string>

namespace facet_mapping {

/// A name beside `path` that no file has yet; makes missing folders. For writers that open the file
/// themselves. Throws std::runtime_error if `path` is a folder or its folder cannot be made.
std::string temporary_beside(const std::string& path);

/// Flushes `temporary` to the disk and renames it to `path`, replacing what was there. Throws
/// std::runtime_error (and removes `temporary`) if either fails.
void publish_file(const std::string& temporary, const std::string& path);

/// Collects bytes in a temporary file beside `path`; commit() gives it its name. Without commit()
/// the temporary is removed and whatever stood at `path` before is untouched. All functions throw
/// std::runtime_error with path and reason (no space, no permission ...).
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void write(const std::string& text) { write(text.data(), text.size()); }
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  int descriptor_ = -1;
};

}  // namespace facet_mapping
