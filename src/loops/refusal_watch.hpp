// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports to the user the refused input of others, with the source address: PDUs with a forged
// issuer, orders, touches, entities beyond the tables.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_condition.hpp"
#include "reckon/peer/loops/notice_gate.hpp"
#include "reckon/peer/loops/silence_watch.hpp"
#include "reckon/peer/world/disputes.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// One thread; fixed memory, no allocation.
class RefusalWatch {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  /// Notices pass through `gate` to `out`; both outlive it.
  RefusalWatch(NoticeGate& gate, haptics::SpscRing<Notice>& out) : gate_(gate), out_(out) {}

  /// Reports a refused order of `originator`. @param order "freeze" or "resume"
  void note_order(const pdu::EntityId& originator, std::string_view order,
                  const aoim::SourceAddress& from, Nanoseconds now) noexcept;
  /// Call it some times a second. @param own our simulation
  void look(RemoteEntities& remote, const aoim::PeerId& own, Nanoseconds now) noexcept;
  /// Reports owners that press our hands while the touch rule neither lists owners nor needs a key.
  /// @param touched entities in contact with our hands
  void look(std::span<const Touched> touched, RemoteEntities& remote, Nanoseconds now) noexcept;
  /// Reports bodies that were silent in contact.
  void look(const SilenceWatch& silence, Nanoseconds now) noexcept;

 private:
  /// A count that increases while something is refused.
  struct Growing {
    std::uint64_t before = 0;
    NoticeCondition condition = {};
    [[nodiscard]] bool begins(std::uint64_t count, Nanoseconds now) noexcept;
  };
  void report(const Notice& notice, const aoim::SourceAddress& cause, Nanoseconds now) noexcept {
    gate_.report_refusal(notice, cause, now, out_);
  }
  void report_dispute(const Dispute& dispute, const aoim::PeerId& own, Nanoseconds now) noexcept;

  NoticeGate& gate_;
  haptics::SpscRing<Notice>& out_;
  NoticeCondition orders_;
  Growing untouchable_, evicted_, strangers_, bodies_, inside_, silent_;
  Disputes pushers_;
};

}  // namespace reckon::peer
