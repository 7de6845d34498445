// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A large exercise in simulated time: each peer is the parts of the library that decide what goes
// out (UpdatePolicy, Aggregator, Introduction, FocusCover, Subscription) without its loops, threads
// and tables; a group is a number of listeners. What all receivers of a datagram share is done
// once.
#pragma once

#include <functional>
#include <memory>

#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/bench/studies/scale/setting.hpp"

namespace reckon::bench {

/// Told the share of the run that is done; false ends it.
using ScaleProgress = std::function<bool(double share)>;

/// Gets each datagram: when it leaves [s], its sender, its group, its octets.
using ScaleTap = std::function<void(double time, std::uint32_t sender, aoim::GroupIndex group,
                                    std::span<const std::byte> datagram)>;

/// Runs one row. The same every time but for the CPU. Some 0.4 us an entity and tick that sends,
/// 0.15 us one that does not; some 0.5 MB a peer with a hundred entities and 1,000 groups. @throws
/// UsageError for a setting that cannot be, with the remedy  @return counts; of less time where
/// progress ended it
[[nodiscard]] ScaleCounts run_world(const ScaleSetting& setting, const ScaleDesign& design,
                                    const ScaleProgress& progress = {}, const ScaleTap& tap = {});

}  // namespace reckon::bench
