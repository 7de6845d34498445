// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What is reported of others, so that nobody on the network fills the user's terminal or log: of
// the strangers of a host together one line a second, with the number of those that were left out.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/notice.hpp"

namespace reckon::peer {

/// Lets notices of others through or counts them, by the host (address) that caused them. One
/// thread; fixed memory, no allocation, some 100 ns a notice.
class NoticeGate {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Lines of strangers of one host: so many at once where it has caused none for long, then one
  /// each kGap. The eight peers of a demonstration come at once.
  static constexpr int kAtOnce = 8;
  static constexpr Nanoseconds kGap = std::chrono::seconds(1);
  /// Who has been heard for so long is no stranger. The members of one host have lines of their
  /// own: so many at once, then one each kGap.
  static constexpr Nanoseconds kMember = std::chrono::seconds(10);
  static constexpr int kAtOnceOfMembers = 64;
  /// Hosts kept apart; those beyond count as one.
  static constexpr std::size_t kHosts = 32;

  /// Something happened to a peer, or a peer did something. What is about this peer itself passes.
  void tell(const aoim::PresenceEvent& event, Nanoseconds now,
            haptics::SpscRing<Notice>& out) noexcept;
  /// A host floods, or no more.
  void tell(const MutedSender& sender, Nanoseconds now, haptics::SpscRing<Notice>& out) noexcept;
  /// Something was said from `cause` that is refused: in another's name, an order, a touch.
  void tell_refused(const Notice& notice, const aoim::SourceAddress& cause, Nanoseconds now,
                    haptics::SpscRing<Notice>& out) noexcept {
    tell(notice, cause, false, now, out);
  }
  /// Tells how many were left out, where a line is due; call it some times a second.
  void look(Nanoseconds now, haptics::SpscRing<Notice>& out) noexcept;

 private:
  using Octets = decltype(aoim::SourceAddress::octets);
  struct Host {
    Octets address{};
    Nanoseconds last{Nanoseconds::min() / 2};       // that it caused something
    Nanoseconds strangers{Nanoseconds::min() / 2};  // when all their lines are free again
    Nanoseconds members{Nanoseconds::min() / 2};    // the same
    std::uint64_t left_out = 0;
    Notice latest;  // of those left out
  };

  [[nodiscard]] Host& host_of(const Octets& address) noexcept;
  void tell(const Notice& notice, const aoim::SourceAddress& cause, bool member, Nanoseconds now,
            haptics::SpscRing<Notice>& out) noexcept;

  std::array<Host, kHosts> hosts_{};  // the last one: all others
  std::size_t count_ = 0;             // of the others
};

}  // namespace reckon::peer
