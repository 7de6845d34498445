// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How many peers and entities a LAN and its hosts carry, and which limit is reached first. Both
// come from a sweep over numbers of peers with as many entities each.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/fit.hpp"

namespace reckon::bench {

/// Resources that a peer may use.
struct HostLimits {
  double link = 1e9;        ///< capacity of the LAN at each host [bit/s], > 0
  double link_share = 0.5;  ///< share of it that the exercise may use
  double core_share = 0.5;  ///< share of one core that a peer may use
  LiveCosts costs{};        ///< of a peer on this host
};

/// The largest exercise that a mechanism supports.
struct Capacity {
  std::size_t mechanism = 0;
  double peers = 0;        ///< most; kFarthest times the sweep's if no limit is near
  double entities = 0;     ///< with as many a peer as in the sweep
  std::string_view limit;  ///< first limit reached, in words; empty: none is near
  bool within = false;     ///< the limit is within the sweep, else beyond its last exercise
};

/// One for each mechanism, from the two largest exercises with as many entities a peer. Between and
/// beyond them, each quantity grows as a power of the number of peers. Empty for fewer than two.
[[nodiscard]] std::vector<Capacity> capacities(std::span<const ScaleRow> rows,
                                               const HostLimits& limits);

/// A sentence for all mechanisms together and one for dead reckoning alone; empty without any.
[[nodiscard]] std::string capacity_text(std::span<const Capacity> capacities,
                                        const HostLimits& limits);
/// A line for each.
[[nodiscard]] std::string capacity_json(std::span<const Capacity> capacities);

}  // namespace reckon::bench
