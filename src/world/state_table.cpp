// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/state_table.hpp"

#include <algorithm>
#include <bit>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/peer/clocks/seconds.hpp"

namespace reckon::peer {

deadreckon::Pose RemoteEntity::predicted(std::chrono::nanoseconds now) const noexcept {
  return held(deadreckon::extrapolate(state, age(now)), now);
}

deadreckon::Pose RemoteEntity::expected(std::chrono::nanoseconds now) const noexcept {
  if (!adaptive || frozen || order.history().size() == 0) return predicted(now);
  return held(order.predict(age(now)), now);
}

// Past the time-out nothing is known any more: hold rather than run away.
double RemoteEntity::age(std::chrono::nanoseconds now) const noexcept {
  return frozen ? 0.0 : std::min(to_seconds(now - state_time), timeout);
}

deadreckon::Pose RemoteEntity::held(deadreckon::Pose pose,
                                    std::chrono::nanoseconds now) const noexcept {
  if (to_seconds(now - state_time) > timeout) {
    pose.velocity.setZero();
    pose.angular_velocity.setZero();
  }
  return pose;
}

deadreckon::Pose RemoteEntity::shown(std::chrono::nanoseconds now) const noexcept {
  return convergence.shown(expected(now), to_seconds(now));
}

StateTable::StateTable(std::size_t capacity)
    : rows_(capacity), index_(std::bit_ceil(2 * capacity + 1), kEmpty) {}

std::size_t StateTable::home(const pdu::EntityId& id) const noexcept {
  const std::uint64_t key = (static_cast<std::uint64_t>(id.site) << 32) |
                            (static_cast<std::uint64_t>(id.application) << 16) | id.entity;
  return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32) & (index_.size() - 1);
}

std::size_t StateTable::slot_of(const pdu::EntityId& id) const noexcept {
  std::size_t slot = home(id);
  while (index_[slot] != kEmpty && rows_[index_[slot]].id != id) {
    slot = (slot + 1) & (index_.size() - 1);
  }
  return slot;
}

RemoteEntity* StateTable::find(const pdu::EntityId& id) noexcept {
  const std::uint32_t row = index_[slot_of(id)];
  return row == kEmpty ? nullptr : &rows_[row];
}

const RemoteEntity* StateTable::find(const pdu::EntityId& id) const noexcept {
  const std::uint32_t row = index_[slot_of(id)];
  return row == kEmpty ? nullptr : &rows_[row];
}

RemoteEntity* StateTable::find_or_add(const pdu::EntityId& id, bool& added) noexcept {
  const std::size_t slot = slot_of(id);
  added = index_[slot] == kEmpty;
  if (!added) return &rows_[index_[slot]];
  if (count_ == rows_.size()) return nullptr;

  rows_[count_] = RemoteEntity();
  rows_[count_].id = id;
  index_[slot] = static_cast<std::uint32_t>(count_);
  return &rows_[count_++];
}

void StateTable::erase(const pdu::EntityId& id) noexcept {
  const std::size_t slot = slot_of(id);
  const std::uint32_t row = index_[slot];
  if (row == kEmpty) return;

  // The last row moves into the hole; its index entry is found before anything changes.
  const std::size_t last = count_ - 1;
  const std::size_t last_slot = slot_of(rows_[last].id);
  index_[last_slot] = row;
  rows_[row] = rows_[last];
  --count_;
  close_gap(slot);
}

void StateTable::close_gap(std::size_t gap) noexcept {
  const std::size_t mask = index_.size() - 1;
  for (std::size_t next = (gap + 1) & mask; index_[next] != kEmpty; next = (next + 1) & mask) {
    const std::size_t wanted = home(rows_[index_[next]].id);
    // An entry may move back to the gap unless its home lies cyclically after the gap.
    if (((next - wanted) & mask) >= ((next - gap) & mask)) {
      index_[gap] = index_[next];
      gap = next;
    }
  }
  index_[gap] = kEmpty;
}

}  // namespace reckon::peer
