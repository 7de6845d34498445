// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits notices caused by others, so that no host on the network can flood the user's terminal or
// log: all strangers of a host together get one line a second, with the number of omitted ones.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/notice.hpp"

namespace reckon::peer {

/// Passes or counts notices about others, by the host (address) that caused them. One thread; fixed
/// memory, no allocation, some 100 ns per notice.
class NoticeGate {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Lines for the strangers of one host: this many at once after a long silence, then one in each
  /// kGap. Enough for the eight peers of a demonstration that start at once.
  static constexpr int kAtOnce = 8;
  static constexpr Nanoseconds kGap = std::chrono::seconds(1);
  /// A peer that was received for this long is a member, not a stranger. The members of one host
  /// have separate lines: this many at once, then one in each kGap.
  static constexpr Nanoseconds kMember = std::chrono::seconds(10);
  static constexpr int kAtOnceOfMembers = 64;
  /// Hosts with separate limits; further ones share one.
  static constexpr std::size_t kHosts = 32;

  /// Takes an event of a peer. Events of this peer itself always pass.
  void report(const aoim::PresenceEvent& event, Nanoseconds now,
              haptics::SpscRing<Notice>& out) noexcept;
  /// Takes the begin or end of a host's flood.
  void report(const MutedSender& sender, Nanoseconds now, haptics::SpscRing<Notice>& out) noexcept;
  /// Takes the refusal of a PDU from `cause`: a forged issuer, an order, a touch.
  void report_refusal(const Notice& notice, const aoim::SourceAddress& cause, Nanoseconds now,
                      haptics::SpscRing<Notice>& out) noexcept {
    report(notice, cause, false, now, out);
  }
  /// Reports the number of omitted notices when a line is due; call it some times a second.
  void look(Nanoseconds now, haptics::SpscRing<Notice>& out) noexcept;

 private:
  using Octets = decltype(aoim::SourceAddress::octets);
  struct Host {
    Octets address{};
    Nanoseconds last{Nanoseconds::min() / 2};       // last notice
    Nanoseconds strangers{Nanoseconds::min() / 2};  // when the strangers' burst is available again
    Nanoseconds members{Nanoseconds::min() / 2};    // the same for members
    std::uint64_t left_out = 0;
    Notice latest;  // of the omitted ones
  };

  [[nodiscard]] Host& host_of(const Octets& address) noexcept;
  void report(const Notice& notice, const aoim::SourceAddress& cause, bool member, Nanoseconds now,
              haptics::SpscRing<Notice>& out) noexcept;

  std::array<Host, kHosts> hosts_{};  // the last one: all further hosts
  std::size_t count_ = 0;             // hosts before it
};

}  // namespace reckon::peer
