// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Maps keys to rows of a dense array: for the state table of a peer and the picture of a listener.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

namespace reckon::peer {

/// Places by 64-bit key: open addressing, at most half full. The holder of the rows sets their
/// places:
///
///   if (index.find(key) == KeyIndex::kNone) index.put(key, rows.size()), rows.push_back(row);
///
/// One thread. Allocates nothing up to the number of keys of construction; beyond it the capacity
/// doubles. Memory is reserved at once and touched as keys come: it starts with few slots and
/// doubles them when half are in use, which costs some 20 ns a key each time. A large index halves
/// its slots when a sixteenth is in use.
class KeyIndex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// @param keys capacity without allocating, up to 2^31.  @throws std::bad_alloc
  explicit KeyIndex(std::size_t keys);
  KeyIndex(const KeyIndex& other);
  KeyIndex& operator=(const KeyIndex& other);
  KeyIndex(KeyIndex&&) noexcept = default;
  KeyIndex& operator=(KeyIndex&&) noexcept = default;
  ~KeyIndex() = default;

  /// The place of `key`; kNone if it has none. Some ns.
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const noexcept {
    return slots_[slot_of(key)].mark - 1;
  }
  /// Prefetches the memory that find(key) reads.
  void prefetch(std::uint64_t key) const noexcept { __builtin_prefetch(&slots_[home(key)]); }
  /// Sets the place of `key`, below 2^32 - 1.
  void put(std::uint64_t key, std::size_t place);
  /// Removes a key; does nothing if it has no place.
  void erase(std::uint64_t key) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Capacity in keys without allocating.
  [[nodiscard]] std::size_t room() const noexcept { return reserved_ / 4; }

 private:
  // All zero if free, the same as untouched pages.
  struct Slot {
    std::uint64_t key;
    std::uint32_t mark;  // place + 1
  };
  struct Free {
    void operator()(Slot* slots) const noexcept { std::free(slots); }
  };
  using Slots = std::unique_ptr<Slot[], Free>;

  [[nodiscard]] static Slots zeroed(std::size_t count);
  // Fibonacci hashing: neighbouring keys far apart.
  [[nodiscard]] std::size_t home(std::uint64_t key) const noexcept {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> shift_);
  }
  // The slot of this key, or the free one where it belongs.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept {
    std::size_t slot = home(key);
    while (slots_[slot].mark != 0 && slots_[slot].key != key) slot = (slot + 1) & mask_;
    return slot;
  }
  void grow();
  void shrink() noexcept;

  // n slots begin at place n, n a power of two, so that each doubling finds its own zeros.
  std::size_t reserved_;
  Slots reserve_;
  std::size_t mask_;  // slots - 1
  int shift_;         // 64 - log2 of their number
  Slot* slots_;       // in reserve_
  std::size_t size_ = 0;
};

}  // namespace reckon::peer
