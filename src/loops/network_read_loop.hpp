// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Takes datagrams off the link as fast as they come, so that a busy model loop never makes the
// kernel drop one. Joins and leaves happen here too: a link has one reader.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A datagram in transit to the model loop.
struct InboundDatagram {
  GroupAddress group;
  std::chrono::nanoseconds arrival{0};  ///< our steady time
  std::size_t size = 0;
  std::array<std::byte, kMaxDatagram> octets;
};

/// A group to join or leave, told by the model loop.
struct GroupCommand {
  GroupAddress group;
  bool join = true;
};

/// The loop. step() by one thread; allocates in joins alone.
class NetworkReadLoop {
 public:
  /// All references outlive the loop.
  NetworkReadLoop(Link& link, haptics::SpscRing<GroupCommand>& commands,
                  haptics::SpscRing<InboundDatagram>& out, Counters& counters);

  /// Carries out joins and leaves, then takes everything that has arrived. A group that could not
  /// be joined is tried again each second. Returns datagrams taken.
  std::size_t step(std::chrono::nanoseconds now) noexcept;

 private:
  static constexpr std::size_t kBatch = 64;
  void obey(const GroupCommand& command) noexcept;
  void retry_joins(std::chrono::nanoseconds now) noexcept;
  void take_datagram(const Datagram& datagram, std::chrono::nanoseconds now) noexcept;

  Link& link_;
  haptics::SpscRing<GroupCommand>& commands_;
  haptics::SpscRing<InboundDatagram>& out_;
  std::array<Datagram, kBatch> batch_{};
  std::vector<GroupAddress> unjoined_;  ///< wanted, and refused by the link
  std::chrono::nanoseconds next_retry_{0};
  Counter& datagrams_;
  Counter& octets_;
  Counter& overflow_;
  Counter& join_errors_;
  Counter& groups_unjoined_;
};

}  // namespace reckon::peer
