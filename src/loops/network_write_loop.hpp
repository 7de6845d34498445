// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Puts finished datagrams on the link, so that a slow send never holds up the model loop.
#pragma once

#include <array>
#include <cstddef>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A finished datagram on its way out.
struct Outbound {
  GroupAddress group;
  std::size_t size = 0;
  std::array<std::byte, kMaxDatagram> octets;
};

/// The loop. step() by one thread; no allocation.
class NetworkWriteLoop {
 public:
  NetworkWriteLoop(Link& link, haptics::SpscRing<Outbound>& in, Counters& counters);

  /// Sends all that waits; returns how many datagrams. One that the kernel refuses is counted and
  /// gone: the next update repairs it.
  std::size_t step() noexcept;

 private:
  Link& link_;
  haptics::SpscRing<Outbound>& in_;
  Counter& datagrams_;
  Counter& octets_;
  Counter& errors_;
};

}  // namespace reckon::peer
