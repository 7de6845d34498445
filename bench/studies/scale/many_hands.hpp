// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Many peers with a hand each, few of which touch. Measures the traffic of all over a whole run,
// with and without dead reckoning of the force, against a stream of every servo step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/contact/contact_measures.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::bench {

/// Most peers of a run, and most of them that touch, in pairs.
inline constexpr std::size_t kManyHands = 64, kManyTouching = 4;
/// Force errors at which hands send [N]: with dead reckoning of the force; without it, where each
/// change is sent.
inline constexpr std::array kManyThresholds{0.015, 0.0001};

/// One run. Rates are sums over all peers; octets include headers of UDP and IPv4.
struct ManyHandsRow {
  double threshold = 0;  ///< [N]
  std::size_t peers = 0, touching = 0;
  double packets_per_s = 0, octets_per_s = 0;
  ForceError error;  ///< of touching hands during contact, against stiffness x overlap
};
/// Traffic of so many hands that each send an Entity State and a force model at each servo step.
struct RawStream {
  double packets_per_s = 0, octets_per_s = 0;
};
[[nodiscard]] RawStream raw_stream_of(std::size_t peers);

/// Runs 22 s of whole peers in simulated time for each threshold. One core takes some 2 s for 4
/// peers, two minutes for 64. @param peers 2 .. kManyHands  @param network between them
/// @param seed of the network  @param go_on called ten times a simulated second; false ends the
/// study with fewer rows
[[nodiscard]] std::vector<ManyHandsRow> run_many_hands(
    std::size_t peers, const peer::ImpairmentLaw& network, std::uint64_t seed,
    const std::function<bool(double share)>& go_on = {});

[[nodiscard]] std::string many_hands_text(std::span<const ManyHandsRow> rows);
/// A line of kind "many_hands" for each.
[[nodiscard]] std::string many_hands_json(std::span<const ManyHandsRow> rows);

}  // namespace reckon::bench
