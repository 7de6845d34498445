// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The last Entity State of each entity heard in the groups that this peer has joined, and its force
// model, so that it can tell them to who comes late.
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
  /// Longer states, of entities with many parts, are not kept [octets].
  static constexpr std::size_t kLongest = 400;

  struct Entry {
    std::uint32_t epoch = 0;          ///< life of the owner
    GroupIndex group;                 ///< where it was heard last
    std::chrono::nanoseconds heard{};  ///< and when
    std::vector<std::byte> octets;    ///< an Entity State PDU
    std::vector<std::byte> model;     ///< a HapticRecord; empty: it has no force model
  };

  /// Of more entities no state is kept; see refused().
  explicit StateStore(std::size_t capacity = 16'384) : capacity_(capacity) {}

  /// What an owner said last. One that leaves is forgotten. About 0.2 us.
  void note(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
            std::span<const std::byte> octets, std::chrono::nanoseconds now);
  /// Records that extend the state of an entity, as its owner said them: its force model is kept.
  void note_records(std::uint32_t epoch, const pdu::EntityId& entity,
                    std::span<const std::byte> records);
  /// What somebody else says that the owner said: only where the owner was not heard.
  void note_if_new(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
                   std::span<const std::byte> octets, std::chrono::nanoseconds heard);
  /// This life is over.
  void forget(std::uint32_t epoch);
  /// This entity of that life is elsewhere; nothing where it is another life's.
  void forget(std::uint32_t epoch, const pdu::EntityId& entity);
  /// This group is left: what is in it is no longer heard.
  void forget(GroupIndex group);

  /// Entities heard last in this group, in the order of their ids.
  [[nodiscard]] std::vector<pdu::EntityId> entities(GroupIndex group) const;
  /// Null where nothing is kept of it.
  [[nodiscard]] const Entry* find(const pdu::EntityId& entity) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  /// States not kept, for want of room or because they are too long.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  std::size_t capacity_;
  std::unordered_map<std::uint64_t, Entry> entries_;  ///< by site, application and entity
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::aoim
