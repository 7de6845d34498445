// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time of arrival of a datagram, and its sender.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"

namespace reckon::peer {

/// Metadata of an update, besides its octets.
struct Arrival {
  std::chrono::nanoseconds now{0};      ///< steady time of this pass
  std::chrono::nanoseconds utc{0};      ///< the same instant in UTC
  std::chrono::nanoseconds arrival{0};  ///< steady time at which the link received it, <= now
  std::uint32_t epoch = 0;              ///< 0 = plain DIS
  ClockEvidence clock;                  ///< knowledge of the sender's clock
  aoim::SourceAddress from = {};        ///< stated source address
  /// The near or contact group in which it arrived; the base group for all others.
  aoim::GroupIndex group = aoim::kBaseGroup;
  bool is_unicast = false;  ///< sent to this host alone
};

}  // namespace reckon::peer
