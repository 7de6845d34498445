// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/key_index.hpp"

#include <algorithm>
#include <bit>
#include <new>
#include <utility>

#include "reckon/peer/world/large_pages.hpp"

namespace reckon::peer {

namespace {
constexpr std::size_t kFirstSlots = 256;
}  // namespace

KeyIndex::KeyIndex(std::size_t keys)
    : reserved_(2 * std::bit_ceil(2 * std::max<std::size_t>(keys, 1))),
      reserve_(zeroed(reserved_)),
      mask_(std::min(kFirstSlots, reserved_ / 2) - 1),
      shift_(64 - std::countr_zero(mask_ + 1)),
      slots_(&reserve_[mask_ + 1]) {}

KeyIndex::KeyIndex(const KeyIndex& other)
    : reserved_(other.reserved_),
      reserve_(zeroed(reserved_)),
      mask_(other.mask_),
      shift_(other.shift_),
      slots_(&reserve_[mask_ + 1]),
      size_(other.size_) {
  std::copy_n(other.slots_, mask_ + 1, slots_);
}

KeyIndex& KeyIndex::operator=(const KeyIndex& other) { return *this = KeyIndex(other); }

// calloc gets large tables from the system, which already contain zeros.
KeyIndex::Slots KeyIndex::zeroed(std::size_t count) {
  auto* slots = static_cast<Slot*>(std::calloc(count, sizeof(Slot)));
  if (slots == nullptr) throw std::bad_alloc();
  advise_large_pages(slots, count * sizeof(Slot));
  return Slots(slots);
}

void KeyIndex::put(std::uint64_t key, std::size_t place) {
  std::size_t slot = slot_of(key);
  if (slots_[slot].mark == 0) {
    if (2 * size_ > mask_) {
      grow();
      slot = slot_of(key);
    }
    ++size_;
  }
  slots_[slot] = {key, static_cast<std::uint32_t>(place) + 1};
}

void KeyIndex::grow() {
  const std::size_t before = mask_ + 1;
  const Slot* const narrow = slots_;
  Slots outgrown;
  if (4 * before > reserved_) {
    reserved_ = 4 * before;
    outgrown = std::exchange(reserve_, zeroed(reserved_));
  }
  mask_ = 2 * before - 1;
  --shift_;
  slots_ = &reserve_[2 * before];
  for (std::size_t i = 0; i < before; ++i)
    if (narrow[i].mark != 0) slots_[slot_of(narrow[i].key)] = narrow[i];
}

void KeyIndex::erase(std::uint64_t key) noexcept {
  std::size_t gap = slot_of(key);
  if (slots_[gap].mark == 0) return;
  --size_;
  for (std::size_t next = (gap + 1) & mask_; slots_[next].mark != 0; next = (next + 1) & mask_) {
    // a slot may move back to the gap unless its home comes cyclically after the gap
    if (((next - home(slots_[next].key)) & mask_) < ((next - gap) & mask_)) continue;
    slots_[gap] = slots_[next];
    gap = next;
  }
  slots_[gap] = {};
  constexpr std::size_t kMany = 2 * kWorthGivingBack / sizeof(Slot);
  if (mask_ >= kMany && 16 * size_ < mask_) shrink();
}

void KeyIndex::shrink() noexcept {
  const std::size_t before = mask_ + 1;
  Slot* const wide = slots_;
  mask_ = before / 2 - 1;
  ++shift_;
  slots_ = &reserve_[before / 2];
  std::fill_n(slots_, before / 2, Slot{});
  for (std::size_t i = 0; i < before; ++i)
    if (wide[i].mark != 0) slots_[slot_of(wide[i].key)] = wide[i];
  std::fill_n(wide, before, Slot{});  // required by the next doubling
  give_back_pages(wide, before * sizeof(Slot));
}

}  // namespace reckon::peer
