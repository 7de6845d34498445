// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/group_pool.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace reckon::aoim {

using std::chrono::nanoseconds;

GroupPool::GroupPool(std::size_t groups, nanoseconds quarantine)
    : quarantine_(quarantine), slots_(groups) {
  if (groups < 1 || groups > kMaximumPool) {
    throw std::invalid_argument("a pool of " + std::to_string(groups) + " groups: take 1 to 1000");
  }
}

GroupPool::Slot* GroupPool::find(CellId cell) noexcept {
  const auto found = std::find_if(slots_.begin(), slots_.end(), [cell](const Slot& slot) {
    return slot.used && slot.cell == cell;
  });
  return found == slots_.end() ? nullptr : &*found;
}

std::optional<GroupIndex> GroupPool::take(CellId cell, nanoseconds now) {
  const auto index_of = [this](const Slot* slot) {
    return GroupIndex{static_cast<std::uint16_t>(slot - slots_.data() + 1)};
  };
  if (const Slot* own = find(cell)) return index_of(own);
  Slot* best = nullptr;
  for (Slot& slot : slots_) {
    if (slot.used || (!slot.fresh && now - slot.since < quarantine_)) continue;
    const bool longer = best == nullptr || (slot.fresh && !best->fresh) ||
                        (slot.fresh == best->fresh && slot.since < best->since);
    if (longer) best = &slot;
  }
  if (best == nullptr) return {};
  *best = {cell, true, false, true, now};
  return index_of(best);
}

void GroupPool::give_back(CellId cell, nanoseconds now) noexcept {
  if (Slot* slot = find(cell)) *slot = {cell, false, false, true, now};
}

void GroupPool::begin(std::span<const pdu::CellGroup> map, bool fresh, nanoseconds now) {
  for (Slot& slot : slots_) slot = {{}, false, fresh, false, now};
  for (const pdu::CellGroup& entry : map) {
    if (entry.group < 1 || entry.group > slots_.size()) continue;
    slots_[entry.group - 1u] = {{entry.column, entry.row}, true, false, true, now};
  }
}

void GroupPool::merge(std::span<const pdu::CellGroup> map, nanoseconds now) {
  for (const pdu::CellGroup& entry : map) {
    if (entry.group < 1 || entry.group > slots_.size()) continue;
    Slot& slot = slots_[entry.group - 1u];
    const bool same = slot.used && slot.cell == CellId{entry.column, entry.row};
    if (!same) slot = {{}, false, false, true, now};
  }
}

std::size_t GroupPool::in_use() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.used; }));
}

}  // namespace reckon::aoim
