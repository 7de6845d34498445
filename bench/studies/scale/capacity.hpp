// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How many peers and entities a LAN and its hosts carry, and what limits first: from a sweep over
// numbers of peers with as many entities each.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/fit.hpp"

namespace reckon::bench {

/// What a peer may take.
struct HostLimits {
  double link = 1e9;        ///< of the LAN, at each host [bit/s], > 0
  double link_share = 0.5;  ///< of it, that the exercise may take
  double core_share = 0.5;  ///< of one core, that a peer may take
  double datagram = 0.0;    ///< CPU that the kernel takes of a peer for one heard [s]
};

/// CPU of the kernel in reading what all peers of a run hear [s].
[[nodiscard]] double kernel_cpu(const WholeCounts& counts, const HostLimits& limits);

/// How far a mechanism goes.
struct Capacity {
  std::size_t mechanism = 0;
  double peers = 0;        ///< most; where no limit is near, kFarthest times the sweep's
  double entities = 0;     ///< at as many a peer as in the sweep
  std::string_view limit;  ///< what is reached first, in words; empty: no limit is near
  bool within = false;     ///< the limit is within the sweep, else beyond its last exercise
};

/// One for each mechanism, from the two largest exercises with as many entities a peer: between and
/// beyond them each quantity grows by a power of the number of peers. Empty for fewer than two.
[[nodiscard]] std::vector<Capacity> capacities(std::span<const ScaleRow> rows,
                                               const HostLimits& limits);

/// A sentence for all mechanisms together, and one for dead reckoning alone; empty without.
[[nodiscard]] std::string capacity_text(std::span<const Capacity> capacities,
                                        const HostLimits& limits);
/// A line for each.
[[nodiscard]] std::string capacity_json(std::span<const Capacity> capacities);

}  // namespace reckon::bench
