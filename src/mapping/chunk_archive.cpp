// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/mapping/chunk_archive.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "mapping/chunk_bytes.h"
#include "mapping/scratch_folder.h"

#include "facet_mapping/io/atomic_file.h"

namespace facet_mapping {

ChunkArchive::ChunkArchive(std::string parent_folder, OnProblem on_problem)
    : parent_(std::move(parent_folder)), on_problem_(std::move(on_problem)) {
  if (parent_.empty()) {
    std::error_code error;
    parent_ = std::filesystem::temp_directory_path(error).string();
  }
}

ChunkArchive::~ChunkArchive() {
  clear();
}

void ChunkArchive::add(std::vector<MeshChunk> chunks) {
  for (MeshChunk& chunk : chunks) {
    totals_ += totals_of(chunk);
    const ChunkKey key = chunk.key;
    unwritten_.emplace(key, std::move(chunk));
  }
  if (unwritten_.empty()) {
    return;
  }
  try {
    make_folder();
    write();
    failing_ = false;
  } catch (const std::runtime_error& e) {
    if (!failing_ && on_problem_) {
      on_problem_(
          "the part of the map that is frozen stays in memory, since it cannot be archived: " +
          std::string(e.what()) + "; free some space or set archive_folder");
    }
    failing_ = true;
  }
}

void ChunkArchive::make_folder() {
  if (folder_.empty()) {
    remove_abandoned_folders(parent_);
    folder_ = make_scratch_folder(parent_, &lock_);
  }
}

std::string ChunkArchive::file_name(std::uint32_t file) const {
  return (std::filesystem::path(folder_) / (std::to_string(file) + ".chunks")).string();
}

void ChunkArchive::write() {
  std::vector<char> bytes;
  std::map<ChunkKey, Place> places;
  for (const auto& [key, chunk] : unwritten_) {
    const std::uint64_t offset = bytes.size();
    append_chunk(chunk, &bytes);
    places[key] = {files_, offset, bytes.size() - offset};
  }
  AtomicFile file(file_name(files_));
  file.write(bytes.data(), bytes.size());
  file.commit();
  ++files_;
  bytes_on_disk_ += bytes.size();
  places_.merge(places);
  unwritten_.clear();
}

void ChunkArchive::for_each(const Wanted& wanted,
                            const std::function<void(const MeshChunk&)>& visit) const {
  std::string damaged;
  std::ifstream stream;
  std::uint32_t open_file = files_;  // none
  for (const auto& [key, place] : places_) {
    if (!wanted(key)) {
      continue;
    }
    if (place.file != open_file) {
      stream = std::ifstream(file_name(place.file), std::ios::binary);
      open_file = place.file;
    }
    std::vector<char> bytes(place.length);
    stream.clear();
    stream.seekg(static_cast<std::streamoff>(place.offset));
    try {
      if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
        throw std::runtime_error("it cannot be read");
      }
      visit(parse_chunk(bytes));
    } catch (const std::runtime_error& e) {
      damaged = "'" + file_name(place.file) + "': " + e.what();
    }
  }
  for (const auto& [key, chunk] : unwritten_) {
    if (wanted(key)) {
      visit(chunk);
    }
  }
  if (!damaged.empty()) {
    throw std::runtime_error("a part of the map is missing, since its archive was damaged: " +
                             damaged);
  }
}

std::size_t ChunkArchive::bytes() const {
  constexpr std::size_t kTreeNode = 96;  // of places_, on the heap
  std::size_t bytes = kTreeNode * size();
  for (const auto& [key, chunk] : unwritten_) {
    bytes += chunk.bytes();
  }
  return bytes;
}

void ChunkArchive::clear() {
  if (!folder_.empty()) {
    remove_scratch_folder(folder_, &lock_);
    folder_.clear();
  }
  places_.clear();
  unwritten_.clear();
  totals_ = {};
  bytes_on_disk_ = 0;
  files_ = 0;
  failing_ = false;
}

}  // namespace facet_mapping
