// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/change_list.hpp"

namespace reckon::peer {

// At most the rows of the last take() can be removed.
ChangeList::ChangeList(std::size_t capacity) : noted_(capacity) {
  present_.reserve(capacity);
  gone_.reserve(capacity);
  taken_.reserve(2 * capacity);
}

void ChangeList::discovered() {
  if (noted_.capacity() == 0) return;
  noted_.push(kNone);
  note(noted_.size() - 1, Change::discovered);
}

void ChangeList::updated(std::size_t place) noexcept {
  if (noted_.capacity() == 0 || noted_[place] != kNone) return;
  note(place, Change::updated);
}

void ChangeList::removed(std::size_t place, const pdu::EntityId& id, Removal cause) noexcept {
  if (noted_.capacity() == 0) return;
  const std::uint32_t entry = noted_[place];
  const bool untold = entry != kNone && present_[entry].change == Change::discovered;
  if (!untold) gone_.push_back({id, Change::removed, cause});
  if (entry != kNone) forget(entry);
  noted_.erase(place);
  if (place < noted_.size() && noted_[place] != kNone)
    present_[noted_[place]].row = static_cast<std::uint32_t>(place);
}

void ChangeList::note(std::size_t place, Change change) noexcept {
  noted_[place] = static_cast<std::uint32_t>(present_.size());
  present_.push_back({static_cast<std::uint32_t>(place), change});
}

// Moves the last entry to the free place.
void ChangeList::forget(std::uint32_t entry) noexcept {
  present_[entry] = present_.back();
  noted_[present_[entry].row] = entry;
  present_.pop_back();
}

std::span<const EntityChange> ChangeList::take(std::span<const RemoteEntity> rows) noexcept {
  // an entity that returns under an ID was removed under it before
  taken_.assign(gone_.begin(), gone_.end());
  for (const Present& present : present_) {
    taken_.push_back({rows[present.row].id, present.change});
    noted_[present.row] = kNone;
  }
  gone_.clear();
  present_.clear();
  return taken_;
}

}  // namespace reckon::peer
