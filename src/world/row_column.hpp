// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Values parallel to the rows of a table: for values that few loops read, or that one loop reads
// for all rows.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reckon/peer/world/large_pages.hpp"

namespace reckon::peer {

/// One value for each row. It grows at the end; when a row is erased, the last takes its place. One
/// thread. Address space is reserved at construction, so values never move when it grows. Memory is
/// touched only as rows come, by pages of 2 MiB once there are many. When less than half of the
/// rows remain, the memory of the others is given back.
template <typename T>
class RowColumn {
 public:
  /// @param capacity most rows.
  explicit RowColumn(std::size_t capacity) : capacity_(capacity) {
    values_.reserve(capacity);
    advise_large_pages(values_.data(), capacity * sizeof(T));
  }

  /// Adds the value of a new row, below the capacity.
  T& push(const T& value = T()) {
    if (values_.size() == touched_) ++touched_;
    return values_.emplace_back(value);
  }
  /// Moves the value of the last row to `place`, which is below size().
  void erase(std::size_t place) noexcept {
    if (place + 1 < values_.size()) values_[place] = values_.back();
    values_.pop_back();
    constexpr std::size_t kFew = kWorthGivingBack / sizeof(T);
    if (touched_ > kFew + 2 * values_.size()) give_back();
  }

  /// Prefetches the value at `place` for writing.
  void prefetch(std::size_t place) const noexcept {
    const auto* octets = reinterpret_cast<const std::byte*>(&values_[place]);
    for (std::size_t at = 0; at < sizeof(T); at += 64) __builtin_prefetch(octets + at, 1);
  }
  [[nodiscard]] T& operator[](std::size_t place) noexcept { return values_[place]; }
  [[nodiscard]] const T& operator[](std::size_t place) const noexcept { return values_[place]; }
  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }
  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
  [[nodiscard]] std::span<T> all() noexcept { return values_; }
  [[nodiscard]] std::span<const T> all() const noexcept { return values_; }

 private:
  void give_back() noexcept {
    give_back_pages(values_.data() + values_.size(), (touched_ - values_.size()) * sizeof(T));
    touched_ = values_.size();
  }

  std::size_t capacity_;
  std::size_t touched_ = 0;  // most rows since memory was given back
  std::vector<T> values_;
};

}  // namespace reckon::peer
