// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records the contact sets that the model loop publishes to a servo, if a caller requests it. Part
// of the model loop.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/haptics/exchange/servo_types.hpp"

namespace reckon::peer {

/// Records a set if it differs from the last recorded one: other entities, another update of one,
/// or another end of its validity. One thread; no allocation; does nothing without a ring.
class ContactRecorder {
 public:
  /// @param ring outlives the recorder, or the next call; nullptr: records nothing.
  void record_into(haptics::ContactRing* ring) noexcept { ring_ = ring; }
  /// @param now time from which the servo uses this set
  void note(const haptics::ContactSet& set, std::chrono::nanoseconds now) noexcept {
    if (ring_ != nullptr) record(set, now);
  }

 private:
  // The values that distinguish two records of an entity.
  struct Mark {
    pdu::EntityId id;
    std::uint32_t version = 0;
    std::chrono::nanoseconds valid_until{0};
    friend bool operator==(const Mark&, const Mark&) = default;
  };
  void record(const haptics::ContactSet& set, std::chrono::nanoseconds now) noexcept {
    // If the ring is full, the next set is recorded instead.
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
  [[nodiscard]] bool is_known(const haptics::ContactSet& set) const noexcept {
    if (set.count != count_ || set.frozen != frozen_) return false;
    for (std::size_t i = 0; i < count_; ++i) {
      const haptics::RemoteHand& hand = set.hands[i];
      if (marks_[i] != Mark{hand.id, hand.version, hand.valid_until}) return false;
    }
    return true;
  }

  haptics::ContactRing* ring_ = nullptr;
  std::array<Mark, haptics::kMaxRemoteHands> marks_{};  // of the last set in the ring
  std::size_t count_ = 0;
  bool frozen_ = false;
};

}  // namespace reckon::peer
