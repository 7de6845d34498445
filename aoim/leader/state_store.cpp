// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/state_store.hpp"

#include <algorithm>

#include "reckon/aoim/bundling/attribute_records.hpp"
#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::aoim {
namespace {

std::uint64_t key_of(const pdu::EntityId& id) noexcept {
  return std::uint64_t{id.site} << 32 | std::uint64_t{id.application} << 16 | id.entity;
}

pdu::EntityId id_of(std::uint64_t key) noexcept {
  return {static_cast<std::uint16_t>(key >> 32), static_cast<std::uint16_t>(key >> 16),
          static_cast<std::uint16_t>(key)};
}

}  // namespace

void StateStore::note(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
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
  if (entry.epoch != epoch) entry.model.clear();
  entry.epoch = epoch;
  entry.group = group;
  entry.heard = now;
  entry.octets.assign(octets.begin(), octets.end());
}

void StateStore::note_records(std::uint32_t epoch, const pdu::EntityId& entity,
                              std::span<const std::byte> records) {
  const auto found = entries_.find(key_of(entity));
  if (found == entries_.end() || found->second.epoch != epoch) return;
  while (!records.empty()) {
    const auto record = take_record(records);
    if (record.empty()) return;
    const bool is_model =
        record.size() == pdu::kHapticRecordLength &&
        pdu::load_big_endian<std::uint32_t>(record.data()) == pdu::kHapticRecordType;
    if (is_model) found->second.model.assign(record.begin(), record.end());
  }
}

void StateStore::note_if_new(GroupIndex group, std::uint32_t epoch, const pdu::EntityState& state,
                             std::span<const std::byte> octets, std::chrono::nanoseconds heard) {
  if (find(state.entity_id) == nullptr) note(group, epoch, state, octets, heard);
}

void StateStore::forget(std::uint32_t epoch) {
  std::erase_if(entries_, [epoch](const auto& item) { return item.second.epoch == epoch; });
}

void StateStore::forget(std::uint32_t epoch, const pdu::EntityId& entity) {
  const auto found = entries_.find(key_of(entity));
  if (found != entries_.end() && found->second.epoch == epoch) entries_.erase(found);
}

void StateStore::forget(GroupIndex group) {
  std::erase_if(entries_, [group](const auto& item) { return item.second.group == group; });
}

std::vector<pdu::EntityId> StateStore::entities(GroupIndex group) const {
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

const StateStore::Entry* StateStore::find(const pdu::EntityId& entity) const noexcept {
  const auto found = entries_.find(key_of(entity));
  return found == entries_.end() ? nullptr : &found->second;
}

}  // namespace reckon::aoim
