// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the pending update of an entity in its group's queue, for the aggregator, which searches it
// with every update.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::aoim {

/// Ordinals by group and entity, in rows of 8 entities with neighbouring numbers: 100,000 entities
/// numbered in turn take 0.8 MB, which a second-level cache holds, so that their order does not
/// matter. Rows are found by open addressing, at most half full. Sent updates are not erased: the
/// aggregator detects that the ordinal no longer belongs to the entity. One thread; allocates only
/// in grow.
///
///   std::uint32_t* ordinal = index.find(group, entity);
///   if (ordinal == nullptr || !is_of(entity, *ordinal)) ordinal = index.take(group, entity);
class WaitingIndex {
 public:
  WaitingIndex() { allocate(kLeastSlots); }

  /// Ordinal last set for this entity; 0 if none ever was; null if none of its row was. Valid until
  /// clear or grow. Some ns.
  [[nodiscard]] std::uint32_t* find(GroupIndex group, const pdu::EntityId& entity) noexcept {
    const std::uint32_t row = slots_[slot_of(key_of(group, entity))];
    return row == kNone ? nullptr : &rows_[row].ordinals[entity.entity % kNeighbours];
  }

  /// The same, with a new row if there was none; null if there is no room for it.
  [[nodiscard]] std::uint32_t* take(GroupIndex group, const pdu::EntityId& entity) noexcept {
    const std::uint64_t key = key_of(group, entity);
    std::uint32_t& row = slots_[slot_of(key)];
    if (row == kNone) {
      if (2 * rows_.size() >= slots_.size()) return nullptr;
      row = static_cast<std::uint32_t>(rows_.size());
      rows_.push_back({key, {}});
    }
    return &rows_[row].ordinals[entity.entity % kNeighbours];
  }

  /// Whether most of the rows are free.
  [[nodiscard]] bool is_roomy() const noexcept { return 4 * rows_.size() <= slots_.size(); }
  /// Removes everything. The caller then puts the pending updates again.
  void clear() noexcept {
    slots_.assign(slots_.size(), kNone);
    rows_.clear();
  }
  /// The same, and doubles the room.
  void grow() { allocate(2 * slots_.size()); }

 private:
  static constexpr std::size_t kLeastSlots = 1024;
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::uint16_t kNeighbours = 8;
  struct Row {
    std::uint64_t key;
    std::array<std::uint32_t, kNeighbours> ordinals;
  };

  // Numbers of 16, 16, 16 and 13 bits: no two rows share a key.
  static std::uint64_t key_of(GroupIndex group, const pdu::EntityId& entity) noexcept {
    return std::uint64_t{group.value} << 45 | entity.key() / kNeighbours;
  }

  // Where this row is, or would be. Fibonacci hashing.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept {
    auto slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> shift_);
    while (slots_[slot] != kNone && rows_[slots_[slot]].key != key)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  void allocate(std::size_t slots) {
    slots_.assign(slots, kNone);
    rows_.clear();
    rows_.reserve(slots / 2);
    shift_ = 64 - std::countr_zero(slots);
  }

  std::vector<std::uint32_t> slots_;  // numbers of rows; a power of two
  std::vector<Row> rows_;
  int shift_ = 0;  // 64 - log2 of the slots
};

}  // namespace reckon::aoim
