// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where the row of a key stands in a dense array: under the state table of a peer and the picture
// of a listener.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::peer {

/// Places by 64-bit key: open addressing, at most half full. Whoever holds the rows tells where
/// they go:
///
///   if (index.find(key) == KeyIndex::kNone) index.put(key, rows.size()), rows.push_back(row);
///
/// One thread. Allocates nothing while it holds no more keys than it was made for; beyond them it
/// doubles.
class KeyIndex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// @param keys that it holds without allocating, up to 2^31.
  explicit KeyIndex(std::size_t keys);

  /// The place of `key`; kNone where it has none. Some ns.
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const noexcept {
    return slots_[slot_of(key)].place;
  }
  /// Says that `key` stands at `place`, now or from now on.
  void put(std::uint64_t key, std::size_t place);
  /// Forgets a key; nothing happens where it has no place.
  void erase(std::uint64_t key) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t place = kNone;
  };

  // Fibonacci hashing: neighbouring keys far apart.
  [[nodiscard]] std::size_t home(std::uint64_t key) const noexcept {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> shift_);
  }
  // The slot of this key, or the free one where it belongs.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = home(key);
    while (slots_[slot].place != kNone && slots_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
  }
  void grow();

  std::vector<Slot> slots_;  // a power of two, 2 or more
  int shift_;                // 64 - log2 of that
  std::size_t size_ = 0;
};

}  // namespace reckon::peer
