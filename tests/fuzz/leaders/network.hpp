// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams on their way from host to host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <queue>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/tests/fuzz/leaders/plan.hpp"

namespace reckon::fuzz::leaders {

struct Datagram {
  aoim::GroupIndex group;
  aoim::SourceAddress from;
  std::vector<std::byte> octets;
};

struct Delivery {
  nanoseconds at{};
  std::uint64_t order = 0;  ///< of two at one instant the one sent first
  std::size_t to = 0;
  std::shared_ptr<const Datagram> datagram;
  std::optional<nanoseconds> came{};  ///< where it has waited in a socket since
  bool operator>(const Delivery& other) const noexcept {
    return at != other.at ? at > other.at : order > other.order;
  }
};

using Deliveries = std::priority_queue<Delivery, std::vector<Delivery>, std::greater<>>;

}  // namespace reckon::fuzz::leaders
