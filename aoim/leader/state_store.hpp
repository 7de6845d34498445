// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The last Entity State of each entity received in the joined groups, with its force model and
// owner, kept for newcomers.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "reckon/aoim/bundling/attribute_records.hpp"
#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"
#include "reckon/pdu/reckon/ownership_record.hpp"

namespace reckon::aoim {

/// One thread; allocates when entities are new.
class StateStore {
 public:
  /// Longest state that is kept [octets]; entities with many parts exceed it.
  static constexpr std::size_t kLongest = 400;

  struct Entry {
    std::uint32_t epoch = 0;           ///< epoch of the owner
    GroupIndex group;                  ///< group in which it was received last
    std::chrono::nanoseconds heard{};  ///< time of the last reception
    std::vector<std::byte> octets;     ///< an Entity State PDU
    std::vector<std::byte> records;    ///< its HapticRecord and OwnershipRecord, if it has them
  };

  /// @param capacity most entities; the states of further ones are not kept, see refused()
  explicit StateStore(std::size_t capacity = 16'384) : capacity_(capacity) {}

  /// Records the newest state from an owner. An entity that leaves is removed. About 0.2 us.
  void note(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
            std::span<const std::byte> octets, std::chrono::nanoseconds now) {
    const std::uint64_t key = key_of(state.entity_id);
    if ((state.appearance & pdu::kAppearanceDeactivated) != 0) {
      entries_.erase(key);
      return;
    }
    const bool room = entries_.size() < capacity_ || entries_.count(key) > 0;
    if (!room || octets.size() > kLongest) {
      ++refused_;
      return;
    }
    Entry& entry = entries_[key];
    if (entry.epoch != epoch) entry.records.clear();
    entry.epoch = epoch;
    entry.group = group;
    entry.heard = now;
    entry.octets.assign(octets.begin(), octets.end());
  }
  /// Takes the records that extend a state of the owner, and keeps the newest of each kept type.
  void note_records(std::uint32_t epoch, const pdu::EntityId& entity,
                    std::span<const std::byte> records) {
    const auto found = entries_.find(key_of(entity));
    if (found == entries_.end() || found->second.epoch != epoch) return;
    while (!records.empty()) {
      const auto record = take_record(records);
      if (record.empty()) return;
      if (is_kept(record)) keep_record(record, found->second.records);
    }
  }
  /// Records a relayed state, unless the owner itself was received.
  void note_if_new(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
                   std::span<const std::byte> octets, std::chrono::nanoseconds heard) {
    if (find(state.entity_id) == nullptr) note(group, epoch, state, octets, heard);
  }
  /// Removes all entities of this epoch, which has ended.
  void forget(std::uint32_t epoch) {
    std::erase_if(entries_, [epoch](const auto& item) { return item.second.epoch == epoch; });
  }
  /// Removes an entity of this epoch that has moved to a group that we have not joined; does
  /// nothing if another epoch has it.
  void forget(std::uint32_t epoch, const pdu::EntityId& entity) {
    const auto found = entries_.find(key_of(entity));
    if (found != entries_.end() && found->second.epoch == epoch) entries_.erase(found);
  }
  /// Removes the entities of a group that was left.
  void forget(GroupIndex group) {
    std::erase_if(entries_, [group](const auto& item) { return item.second.group == group; });
  }

  /// Entities received last in this group, in the order of their IDs.
  [[nodiscard]] std::vector<pdu::EntityId> entities(GroupIndex group) const {
    std::vector<std::uint64_t> keys;
    for (const auto& [key, entry] : entries_) {
      if (entry.group == group) keys.push_back(key);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<pdu::EntityId> ids;
    ids.reserve(keys.size());
    for (const std::uint64_t key : keys) ids.push_back(id_of(key));
    return ids;
  }
  /// Null if nothing is kept of it.
  [[nodiscard]] const Entry* find(const pdu::EntityId& entity) const noexcept {
    const auto found = entries_.find(key_of(entity));
    return found == entries_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  /// States not kept because the store was full or they were too long.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  static std::uint32_t type_of(std::span<const std::byte> record) noexcept {
    return pdu::load_big_endian<std::uint32_t>(record.data());
  }
  static bool is_kept(std::span<const std::byte> record) noexcept {
    const std::uint32_t type = type_of(record);
    return (type == pdu::kHapticRecordType && record.size() == pdu::kHapticRecordLength) ||
           (type == pdu::kOwnershipRecordType && record.size() == pdu::kOwnershipRecordLength);
  }
  // Replaces the record of the same type; all kept records of a type have one size.
  static void keep_record(std::span<const std::byte> record, std::vector<std::byte>& kept) {
    std::span<const std::byte> rest = kept;
    std::size_t at = 0;
    while (!rest.empty()) {
      const auto known = take_record(rest);
      if (type_of(known) == type_of(record)) {
        std::ranges::copy(record, kept.begin() + static_cast<std::ptrdiff_t>(at));
        return;
      }
      at += known.size();
    }
    kept.insert(kept.end(), record.begin(), record.end());
  }
  static std::uint64_t key_of(const pdu::EntityId& id) noexcept {
    return std::uint64_t{id.site} << 32 | std::uint64_t{id.application} << 16 | id.entity;
  }
  static pdu::EntityId id_of(std::uint64_t key) noexcept {
    return {static_cast<std::uint16_t>(key >> 32), static_cast<std::uint16_t>(key >> 16),
            static_cast<std::uint16_t>(key)};
  }

  std::size_t capacity_;
  std::unordered_map<std::uint64_t, Entry> entries_;  ///< by site, application and entity
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::aoim
