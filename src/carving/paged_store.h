// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Records under ids that are never used twice; pages without a live record give their memory back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace facet_mapping::carving {

constexpr std::uint32_t kNoId = 0xFFFFFFFF;

template <typename Record>
class PagedStore {
 public:
  /// Throws std::length_error once all ids are used.
  std::uint32_t push(Record record) {
    if (next_ == kNoId) {
      throw std::length_error("carving: all 2^32 ids are used; reset the map");
    }
    if (next_ % kPageSize == 0) {
      pages_.push_back(std::make_unique<Page>());
    }
    Page& page = *pages_.back();
    page.records.push_back(std::move(record));
    page.alive.push_back(true);
    ++page.live;
    ++live_;
    return next_++;
  }

  bool contains(std::uint32_t id) const {
    return id < next_ && pages_[id / kPageSize] && pages_[id / kPageSize]->alive[id % kPageSize];
  }

  Record& operator[](std::uint32_t id) { return pages_[id / kPageSize]->records[id % kPageSize]; }
  const Record& operator[](std::uint32_t id) const {
    return pages_[id / kPageSize]->records[id % kPageSize];
  }

  /// Does nothing if the record is gone already.
  void erase(std::uint32_t id) {
    if (!contains(id)) {
      return;
    }
    std::unique_ptr<Page>& page = pages_[id / kPageSize];
    page->alive[id % kPageSize] = false;
    page->records[id % kPageSize] = Record{};
    --live_;
    if (--page->live == 0 && page->records.size() == kPageSize) {
      page.reset();
    }
  }

  /// Calls visit(id) for every live record in ascending order; visit may erase records.
  template <typename Visit>
  void for_each_id(const Visit& visit) const {
    for (std::size_t p = 0; p < pages_.size(); ++p) {
      for (std::size_t k = 0; pages_[p] && k < pages_[p]->records.size(); ++k) {
        if (pages_[p]->alive[k]) {
          visit(static_cast<std::uint32_t>(p * kPageSize + k));
        }
      }
    }
  }

  std::size_t size() const { return live_; }

  /// Bytes held by the pages (not what records point to).
  std::size_t bytes() const {
    std::size_t bytes = pages_.capacity() * sizeof(pages_[0]);
    for (const auto& page : pages_) {
      bytes += page ? sizeof(Page) + page->records.capacity() * sizeof(Record) : 0;
    }
    return bytes;
  }

 private:
  static constexpr std::uint32_t kPageSize = 1024;
  struct Page {
    Page() {
      records.reserve(kPageSize);
      alive.reserve(kPageSize);
    }
    std::vector<Record> records;
    std::vector<bool> alive;
    std::uint32_t live = 0;
  };

  std::vector<std::unique_ptr<Page>> pages_;
  std::uint32_t next_ = 0;
  std::size_t live_ = 0;
};

}  // namespace facet_mapping::carving
