// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports to the user when a peer reaches its limits (hands at a servo, rows of the state
// table, rings), refuses force models, or receives sealed datagrams without a key.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_condition.hpp"

namespace reckon::peer {

/// Watches the counts of one peer. One thread; allocates only at set-up.
class LimitWatch {
 public:
  /// Makes the counters hands_unfelt and hands_unpressed. `counters` outlives it. @param capacity
  /// rows of the table
  LimitWatch(std::size_t capacity, Counters& counters);

  /// Call it some times a second.
  /// @param unfelt nearby bodies that a servo omits now, the largest number of all servos.
  /// @param unpressed hands of other peers that are near bodies and do not press them now.
  /// @param crowder host of most of the bodies nearby.
  /// @param refused owner of the last refused force model.  @param out receives notices.
  void look(std::size_t unfelt, std::size_t unpressed, const aoim::SourceAddress& crowder,
            const pdu::EntityId& refused, std::chrono::nanoseconds now,
            haptics::SpscRing<Notice>& out) noexcept;

 private:
  /// A counter that increases while something is lost or delayed.
  struct Growing {
    const Counter& counter;
    std::uint64_t before = 0;
    NoticeCondition condition = {};
    NoticeCondition::Turn turn(std::chrono::nanoseconds now) noexcept;
  };

  std::size_t capacity_;
  Counter &most_unfelt_, &most_unpressed_;
  NoticeCondition unfelt_, unpressed_;
  Growing table_full_, write_overflow_, read_waits_, models_refused_, sealed_;
};

}  // namespace reckon::peer
