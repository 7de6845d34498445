// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/contact_recorder.hpp"

namespace reckon::peer {

bool ContactRecorder::is_known(const haptics::ContactSet& set) const noexcept {
  if (set.count != count_ || set.frozen != frozen_) return false;
  for (std::size_t i = 0; i < count_; ++i) {
    const haptics::RemoteHand& hand = set.hands[i];
    if (marks_[i] != Mark{hand.id, hand.version, hand.valid_until}) return false;
  }
  return true;
}

// If the ring is full, the next set is recorded instead.
void ContactRecorder::record(const haptics::ContactSet& set,
                             std::chrono::nanoseconds now) noexcept {
  if (is_known(set)) return;
  haptics::TimedContactSet* slot = ring_->claim();
  if (slot == nullptr) return;
  slot->time = now;
  slot->set = set;
  ring_->publish();
  count_ = set.count;
  frozen_ = set.frozen;
  for (std::size_t i = 0; i < count_; ++i)
    marks_[i] = {set.hands[i].id, set.hands[i].version, set.hands[i].valid_until};
}

}  // namespace reckon::peer
