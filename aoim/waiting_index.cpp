// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/waiting_index.hpp"

#include <algorithm>
#include <bit>

namespace reckon::aoim {
namespace {

constexpr std::size_t kLeastSlots = 1024;

// Four numbers of 16 bits: no two entities share a key.
std::uint64_t key_of(GroupIndex group, const pdu::EntityId& entity) noexcept {
  return std::uint64_t{group.value} << 48 | std::uint64_t{entity.site} << 32 |
         std::uint64_t{entity.application} << 16 | entity.entity;
}

}  // namespace

WaitingIndex::WaitingIndex() : slots_(kLeastSlots), shift_(64 - std::countr_zero(kLeastSlots)) {}

// The slot of this key, or the free one where it belongs. Fibonacci hashing: neighbouring keys far
// apart.
std::size_t WaitingIndex::slot_of(std::uint64_t key) const noexcept {
  const std::size_t mask = slots_.size() - 1;
  auto slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> shift_);
  while (slots_[slot].used && slots_[slot].key != key) slot = (slot + 1) & mask;
  return slot;
}

std::optional<std::uint32_t> WaitingIndex::find(GroupIndex group,
                                                const pdu::EntityId& entity) const noexcept {
  const Slot& slot = slots_[slot_of(key_of(group, entity))];
  if (!slot.used) return std::nullopt;
  return slot.ordinal;
}

void WaitingIndex::put(GroupIndex group, const pdu::EntityId& entity,
                       std::uint32_t ordinal) noexcept {
  const std::uint64_t key = key_of(group, entity);
  Slot& slot = slots_[slot_of(key)];
  if (!slot.used) ++used_;
  slot = {key, ordinal, true};
}

void WaitingIndex::reset(std::size_t live) {
  const std::size_t size = std::max(slots_.size(), std::bit_ceil(4 * live));
  slots_.assign(size, Slot{});
  shift_ = 64 - std::countr_zero(size);
  used_ = 0;
}

}  // namespace reckon::aoim
