// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/key_index.hpp"

#include <bit>

namespace reckon::peer {

KeyIndex::KeyIndex(std::size_t keys)
    : slots_(std::bit_ceil(2 * keys + 1)), shift_(64 - std::countr_zero(slots_.size())) {
  if (slots_.size() < 2) grow();
}

void KeyIndex::put(std::uint64_t key, std::size_t place) {
  std::size_t slot = slot_of(key);
  if (slots_[slot].place == kNone) {
    if (2 * (size_ + 1) > slots_.size()) {
      grow();
      slot = slot_of(key);
    }
    ++size_;
  }
  slots_[slot] = {key, static_cast<std::uint32_t>(place)};
}

void KeyIndex::grow() {
  std::vector<Slot> wider(2 * slots_.size());
  slots_.swap(wider);
  shift_ = 64 - std::countr_zero(slots_.size());
  for (const Slot& slot : wider)
    if (slot.place != kNone) slots_[slot_of(slot.key)] = slot;
}

void KeyIndex::erase(std::uint64_t key) noexcept {
  std::size_t gap = slot_of(key);
  if (slots_[gap].place == kNone) return;
  --size_;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t next = (gap + 1) & mask; slots_[next].place != kNone; next = (next + 1) & mask) {
    // A slot may move back to the gap unless its home lies cyclically after the gap.
    if (((next - home(slots_[next].key)) & mask) < ((next - gap) & mask)) continue;
    slots_[gap] = slots_[next];
    gap = next;
  }
  slots_[gap] = {};
}

}  // namespace reckon::peer
