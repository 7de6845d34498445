// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the pending update of an entity in its group's queue, for the aggregator, which searches it
// with every update.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::aoim {

/// Ordinals by group and entity: open addressing, at most half full. Sent updates are not erased:
/// the aggregator detects that the ordinal no longer belongs to the entity, and the next one takes
/// the entry. One thread; allocates only if reset makes it larger.
///
///   Entry& entry = index.entry(group, entity);   // used or not
///   if (!entry.used || !is_of(entity, entry.ordinal)) index.put(entry, group, entity, next);
class WaitingIndex {
 public:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t ordinal = 0;  ///< last put for this entity
    bool used = false;          ///< false if none ever was
  };

  WaitingIndex() : entries_(kLeastEntries), shift_(64 - std::countr_zero(kLeastEntries)) {}

  /// The entry of this entity, used or free for it; valid until put or reset. Some ns if numbers
  /// come in turn or the index is in a cache; else a miss.
  [[nodiscard]] Entry& entry(GroupIndex group, const pdu::EntityId& entity) noexcept {
    const std::uint64_t key = key_of(group, entity);
    const std::size_t mask = entries_.size() - 1;
    std::size_t slot = slot_of(key);
    // Entities are often sent in turn: this prefetches the entries of the next ones.
    if (slot % 4 == 0) __builtin_prefetch(&entries_[slot_of(key + kSoon)], 1);
    while (entries_[slot].used && entries_[slot].key != key) slot = (slot + 1) & mask;
    return entries_[slot];
  }

  /// Whether put may be called; else reset first.
  [[nodiscard]] bool has_room() const noexcept { return 2 * used_ < entries_.size(); }
  /// Sets the ordinal of an entity's update; `entry` is its entry.
  void put(Entry& entry, GroupIndex group, const pdu::EntityId& entity,
           std::uint32_t ordinal) noexcept {
    if (!entry.used) ++used_;
    entry = {key_of(group, entity), ordinal, true};
  }

  /// Removes everything and makes room for four times `live` entries. The caller then puts the
  /// pending updates again.
  void reset(std::size_t live) {
    const std::size_t size = std::max(entries_.size(), std::bit_ceil(4 * live));
    entries_.assign(size, Entry{});
    shift_ = 64 - std::countr_zero(size);
    used_ = 0;
  }

 private:
  static constexpr std::size_t kLeastEntries = 1024;

  // Four 16-bit numbers: no two entities share a key.
  static std::uint64_t key_of(GroupIndex group, const pdu::EntityId& entity) noexcept {
    return std::uint64_t{group.value} << 48 | entity.key();
  }

  static constexpr std::uint64_t kSoon = 16;

  // Fibonacci hashing of four at a time, which share a cache line: entities are often sent in turn.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept {
    const auto slot = static_cast<std::size_t>(((key >> 2) * 0x9E3779B97F4A7C15ULL) >> shift_);
    return (slot & ~std::size_t{3}) | (key & 3);
  }

  std::vector<Entry> entries_;  // a power of two
  int shift_;                   // 64 - log2 of that
  std::size_t used_ = 0;
};

}  // namespace reckon::aoim
