// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What stands beside the rows of a table, in their order: what few loops read, or one loop reads of
// all.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reckon/peer/world/large_pages.hpp"

namespace reckon::peer {

/// One value for each row. It grows at the end; where a row goes, the last takes its place. One
/// thread. Room is reserved at construction, so values never move by growing and memory is touched
/// only as rows come, by pages of 2 MiB once there are many. When less than half of the rows are
/// left that there were, what the others took is given back.
template <typename T>
class RowColumn {
 public:
  /// @param capacity most rows.
  explicit RowColumn(std::size_t capacity) : capacity_(capacity) {
    values_.reserve(capacity);
    advise_large_pages(values_.data(), capacity * sizeof(T));
  }

  /// For a new row, below the capacity.
  T& push(const T& value = T()) {
    if (values_.size() == touched_) ++touched_;
    return values_.emplace_back(value);
  }
  /// The value of the last row goes to `place`, which is below size().
  void erase(std::size_t place) noexcept {
    if (place + 1 < values_.size()) values_[place] = values_.back();
    values_.pop_back();
    constexpr std::size_t kFew = kWorthGivingBack / sizeof(T);
    if (touched_ > kFew + 2 * values_.size()) give_back();
  }

  /// Has the value at `place` brought near, to be written.
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
