// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where in its group's queue the update of an entity waits: under the aggregator, which looks for
// it with every update.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/aoim/group_index.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::aoim {

/// Ordinals by group and entity: open addressing, at most half full. What has left is not erased:
/// the aggregator sees that the ordinal is not of that entity any more, and the next one takes its
/// place. One thread; allocates only where reset makes it larger.
class WaitingIndex {
 public:
  WaitingIndex();

  /// The ordinal last put for this entity; none where there is none. Some ns.
  [[nodiscard]] std::optional<std::uint32_t> find(GroupIndex group,
                                                  const pdu::EntityId& entity) const noexcept;

  /// Whether put may be called; else reset first.
  [[nodiscard]] bool has_room() const noexcept { return 2 * used_ < slots_.size(); }
  /// Says where the update of an entity waits, from now on.
  void put(GroupIndex group, const pdu::EntityId& entity, std::uint32_t ordinal) noexcept;

  /// Forgets everything and makes room for four times `live` entries; what still waits is then to
  /// be put again.
  void reset(std::size_t live);

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t ordinal = 0;
    bool used = false;
  };
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept;

  std::vector<Slot> slots_;  // a power of two
  int shift_;                // 64 - log2 of that
  std::size_t used_ = 0;
};

}  // namespace reckon::aoim
