// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand of each of many peers, of which few touch: what all of them send over a whole run with and
// without dead reckoning of the force, against a stream of every servo step.
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

/// The most peers of such a run, and how many of them touch at most, two by two.
inline constexpr std::size_t kManyHands = 64, kManyTouching = 4;
/// Errors of the force at which hands send [N]: with dead reckoning of it, and without, where each
/// change is told.
inline constexpr std::array kManyThresholds{0.015, 0.0001};

/// One of these runs; rates are of all peers, headers of UDP and IPv4 in the octets.
struct ManyHandsRow {
  double threshold = 0;  ///< [N]
  std::size_t peers = 0, touching = 0;
  double packets_per_s = 0, octets_per_s = 0;
  ForceError error;  ///< of those that touch, while they do, against stiffness x overlap
};
/// A datagram with an Entity State and a force model of each of so many hands in each servo step.
struct RawStream {
  double packets_per_s = 0, octets_per_s = 0;
};
[[nodiscard]] RawStream raw_stream_of(std::size_t peers);

/// 22 s of whole peers in simulated time for each threshold: of one core some 2 s for 4 peers, two
/// minutes for 64. @param peers 2 .. kManyHands  @param network between them  @param seed of it
/// @param go_on asked ten times a simulated second; false ends it: fewer rows
[[nodiscard]] std::vector<ManyHandsRow> run_many_hands(
    std::size_t peers, const peer::ImpairmentLaw& network, std::uint64_t seed,
    const std::function<bool(double share)>& go_on = {});

[[nodiscard]] std::string many_hands_text(std::span<const ManyHandsRow> rows);
/// A line of kind "many_hands" for each.
[[nodiscard]] std::string many_hands_json(std::span<const ManyHandsRow> rows);

}  // namespace reckon::bench
