// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/state_table.hpp"

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/state_age.hpp"

namespace reckon::peer {

deadreckon::Pose RemoteEntity::predicted(std::chrono::nanoseconds now) const noexcept {
  const StateAge age(now - state_time, timeout, frozen);
  return age.held(deadreckon::extrapolate(state, age.tau));
}

deadreckon::Pose RemoteEntity::expected(std::chrono::nanoseconds now) const noexcept {
  if (!adaptive || frozen || order.history().size() == 0) return predicted(now);
  const StateAge age(now - state_time, timeout, frozen);
  return age.held(order.predict_near(deadreckon::extrapolate(state, age.tau), age.tau));
}

deadreckon::Pose RemoteEntity::shown(std::chrono::nanoseconds now) const noexcept {
  return convergence.shown(expected(now), pdu::to_seconds(now));
}

StateTable::StateTable(std::size_t capacity) : rows_(capacity), index_(capacity) {}

std::uint64_t StateTable::key(const pdu::EntityId& id) noexcept {
  return (std::uint64_t{id.site} << 32) | (std::uint64_t{id.application} << 16) | id.entity;
}

RemoteEntity* StateTable::find(const pdu::EntityId& id) noexcept {
  const std::uint32_t row = index_.find(key(id));
  return row == KeyIndex::kNone ? nullptr : &rows_[row];
}

const RemoteEntity* StateTable::find(const pdu::EntityId& id) const noexcept {
  const std::uint32_t row = index_.find(key(id));
  return row == KeyIndex::kNone ? nullptr : &rows_[row];
}

RemoteEntity* StateTable::find_or_add(const pdu::EntityId& id, bool& added) noexcept {
  RemoteEntity* known = find(id);
  added = known == nullptr;
  if (!added || count_ == rows_.size()) return known;

  rows_[count_] = RemoteEntity();
  rows_[count_].id = id;
  index_.put(key(id), count_);
  return &rows_[count_++];
}

void StateTable::erase(const pdu::EntityId& id) noexcept {
  const std::uint32_t row = index_.find(key(id));
  if (row == KeyIndex::kNone) return;

  // The last row moves into the hole. `id` may be that of a row, so its entry goes first.
  const pdu::EntityId last = rows_[--count_].id;
  index_.erase(key(id));
  if (row == count_) return;
  rows_[row] = rows_[count_];
  index_.put(key(last), row);
}

}  // namespace reckon::peer
