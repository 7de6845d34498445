// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exit of datagrams from the model loop into the ring of the writer. A tap is notified of each.
#pragma once

#include <cstddef>
#include <span>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/peer/loops/model_counters.hpp"
#include "reckon/peer/loops/model_wiring.hpp"

namespace reckon::peer {

/// One thread; no allocation.
class DatagramOutlet {
 public:
  /// References outlive this.
  DatagramOutlet(const ModelWiring& wiring, ModelCounters& counted) noexcept
      : pool_(wiring.pool), ring_(wiring.outbound), tap_(wiring.tap), counted_(counted) {}

  /// Datagrams that the ring has room for.
  [[nodiscard]] std::size_t room() const noexcept { return ring_.room(); }
  /// Sends to a group of the pool; counted and dropped if the writer lags.
  void push(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept;
  /// Drops a stale datagram instead of sending it.
  void drop_stale(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept;

 private:
  void note(aoim::GroupIndex group, std::span<const std::byte> octets, DatagramFate more) noexcept;
  [[nodiscard]] GroupAddress address_of(aoim::GroupIndex group) const noexcept {
    return group == aoim::kBaseGroup ? pool_.base() : pool_.address(group.value - 1u);
  }

  const GroupPool& pool_;
  DatagramRing& ring_;
  DatagramTap* tap_;
  ModelCounters& counted_;
};

}  // namespace reckon::peer
