// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The last Entity State of each entity received in the joined groups, and its force model, kept for
// newcomers.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"

namespace reckon::aoim {

/// One thread; allocates when entities are new.
class StateStore {
 public:
  /// Longest state that is kept [octets]; entities with many parts exceed it.
  static constexpr std::size_t kLongest = 400;

  struct Entry {
    std::uint32_t epoch = 0;          ///< epoch of the owner
    GroupIndex group;                 ///< group in which it was received last
    std::chrono::nanoseconds heard{};  ///< time of the last reception
    std::vector<std::byte> octets;    ///< an Entity State PDU
    std::vector<std::byte> model;     ///< a HapticRecord; empty: it has no force model
  };

  /// @param capacity most entities; the states of further ones are not kept, see refused()
  explicit StateStore(std::size_t capacity = 16'384) : capacity_(capacity) {}

  /// Records the newest state from an owner. An entity that leaves is removed. About 0.2 us.
  void note(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
            std::span<const std::byte> octets, std::chrono::nanoseconds now);
  /// Takes the records that extend a state of the owner, and keeps its force model.
  void note_records(std::uint32_t epoch, const pdu::EntityId& entity,
                    std::span<const std::byte> records);
  /// Records a relayed state, unless the owner itself was received.
  void note_if_new(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
                   std::span<const std::byte> octets, std::chrono::nanoseconds heard);
  /// Removes all entities of this epoch, which has ended.
  void forget(std::uint32_t epoch);
  /// Removes an entity of this epoch that has moved to a group that we have not joined; does
  /// nothing if another epoch has it.
  void forget(std::uint32_t epoch, const pdu::EntityId& entity);
  /// Removes the entities of a group that was left.
  void forget(GroupIndex group);

  /// Entities received last in this group, in the order of their IDs.
  [[nodiscard]] std::vector<pdu::EntityId> entities(GroupIndex group) const;
  /// Null if nothing is kept of it.
  [[nodiscard]] const Entry* find(const pdu::EntityId& entity) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  /// States not kept because the store was full or they were too long.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  std::size_t capacity_;
  std::unordered_map<std::uint64_t, Entry> entries_;  ///< by site, application and entity
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::aoim
