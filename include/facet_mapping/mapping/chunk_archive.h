// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Chunks that do not change any more, on the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "facet_mapping/mapping/chunked_mesh.h"
#include "facet_mapping/mapping/mesh_totals.h"

namespace facet_mapping {

/// Keeps chunks in files of a folder of its own, which goes when the archive goes. What the disk
/// does not take stays in memory. Not thread-safe.
class ChunkArchive {
 public:
  using OnProblem = std::function<void(const std::string& sentence)>;
  using Wanted = std::function<bool(const ChunkKey&)>;

  /// The archive's folder is made in `parent_folder` ("": the system's temporary folder) with the
  /// first chunk; folders there that killed processes left behind are removed. `on_problem` is told
  /// once when writing begins to fail.
  explicit ChunkArchive(std::string parent_folder, OnProblem on_problem = {});
  ~ChunkArchive();
  ChunkArchive(const ChunkArchive&) = delete;
  ChunkArchive& operator=(const ChunkArchive&) = delete;

  /// Takes chunks over, each key once.
  void add(std::vector<MeshChunk> chunks);

  /// Hands out the chunks with a wanted key, one after the other in no defined order, exactly as
  /// they came. Throws std::runtime_error if a file is gone or damaged, after all others were
  /// handed out.
  void for_each(const Wanted& wanted, const std::function<void(const MeshChunk&)>& visit) const;

  std::size_t size() const { return places_.size() + unwritten_.size(); }
  std::size_t unwritten() const { return unwritten_.size(); }
  const MeshTotals& totals() const { return totals_; }
  std::size_t bytes() const;  ///< of memory held
  std::uint64_t bytes_on_disk() const { return bytes_on_disk_; }
  const std::string& folder() const { return folder_; }  ///< "" before the first chunk

  /// Forgets all chunks and removes the folder.
  void clear();

 private:
  struct Place {
    std::uint32_t file = 0;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
  };

  void make_folder();
  void write();
  std::string file_name(std::uint32_t file) const;

  std::string parent_;
  OnProblem on_problem_;
  std::string folder_;
  int lock_ = -1;  ///< descriptor: says that the folder is in use
  std::map<ChunkKey, Place> places_;
  std::map<ChunkKey, MeshChunk> unwritten_;
  MeshTotals totals_;
  std::uint64_t bytes_on_disk_ = 0;
  std::uint32_t files_ = 0;
  bool failing_ = false;
};

}  // namespace facet_mapping
