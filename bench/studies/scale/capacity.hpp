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

#include "reckon/bench/studies/scale/text.hpp"

namespace reckon::bench {

/// What a peer may take.
struct HostLimits {
  double link = 1e9;        ///< of the LAN, at each host [bit/s], > 0
  double link_share = 0.5;  ///< of it, that the exercise may take
  double core_share = 0.5;  ///< of one core, that a peer may take
  /// CPU that a whole peer takes for each datagram heard [s], see peer_read_cost().
  double datagram = 0.0;
};

/// What a whole peer takes for a datagram: twice what the kernel takes of a thread that only waits
/// for it (1.5 to 1.8 times at 5,000 to 50,000 a second, wake_bench). @param bare [s]
[[nodiscard]] constexpr double peer_read_cost(double bare) { return 2.0 * bare; }
/// CPU that decoding and showing an update takes [s] (transport_bench, `taken`).
inline constexpr double kUpdateCost = 0.3e-6;

/// CPU of receiving, of all peers of a row together [s].
[[nodiscard]] double receive_cpu(const ScaleCounts& counts, const HostLimits& limits);

/// Beyond so many times the largest exercise nothing is extrapolated.
inline constexpr double kFarthest = 30;

/// How far a mechanism goes.
struct Capacity {
  std::size_t mechanism = 0;
  double peers = 0;        ///< most; where no limit is near, kFarthest times the sweep's
  double entities = 0;     ///< at as many a peer as in the sweep
  std::string_view limit;  ///< what is reached first, in words; empty: no limit is near
  bool within = false;     ///< the limit is within the sweep, else beyond its last exercise
};

/// One for each mechanism, from the two largest exercises of the sweep: between and beyond them
/// each quantity grows by a power of the number of peers. Empty for fewer than two sizes, or where
/// the entities of a peer differ.
[[nodiscard]] std::vector<Capacity> capacities(std::span<const ScaleRow> rows,
                                               const HostLimits& limits);

/// A sentence for all mechanisms together, and one for dead reckoning alone; empty without.
[[nodiscard]] std::string capacity_text(std::span<const Capacity> capacities,
                                        const HostLimits& limits);
/// A line for each.
[[nodiscard]] std::string capacity_json(std::span<const Capacity> capacities);

}  // namespace reckon::bench
