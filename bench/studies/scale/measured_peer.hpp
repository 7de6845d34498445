// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One whole peer in the middle of a large exercise whose other peers are light: what it hears, and
// what that takes of a core. Its network is simulated, so what the kernel does is not in it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reckon/bench/studies/scale/world.hpp"

namespace reckon::bench {

/// What it heard in one step, and what that took.
struct MeasuredStep {
  std::uint64_t datagrams = 0, updates = 0;
  std::size_t known = 0;  ///< entities in its table then
  double seconds = 0;     ///< since the step before
  double cpu = 0;         ///< [s]
};

/// What it heard in `seconds`; it owns nothing, and senses from the origin.
struct MeasuredPeer {
  std::size_t peers = 0, entities = 0;  ///< of the exercise
  double seconds = 0;
  std::uint64_t datagrams = 0, octets = 0;  ///< taken, with headers of UDP and IPv4
  std::uint64_t updates = 0;                ///< read from them, wanted or not
  std::size_t known = 0;                    ///< entities in its table at the end
  std::size_t groups = 0;                   ///< joined at the end
  double cpu = 0;                           ///< of its loops [s]
  std::vector<MeasuredStep> steps;          ///< that these are the sums of
};

/// Most light peers beside it: each 60 of them have a simulated link of 22 MB.
inline constexpr std::size_t kMostLightPeers = 240;

/// As run_world(). @throws UsageError for more than kMostLightPeers, with the remedy
[[nodiscard]] MeasuredPeer run_measured_peer(const ScaleSetting& setting, const ScaleDesign& design,
                                             const ScaleProgress& progress = {});

/// What a peer's CPU goes to, fitted: datagram x datagrams + update x updates + (idle + entity x
/// known) x seconds, none below 0.
struct PeerCosts {
  double datagram = 0;  ///< [s]
  double update = 0;    ///< [s]
  double entity = 0;    ///< [s] a second
  double idle = 0;      ///< [s] a second
  double spread = 0;    ///< RMS of the share by which the fitted runs are off

  /// Of a run, or a step. [s]
  template <typename Run>
  [[nodiscard]] double of(const Run& run) const {
    return datagram * static_cast<double>(run.datagrams) +
           update * static_cast<double>(run.updates) +
           (idle + entity * static_cast<double>(run.known)) * run.seconds;
  }
};

/// Least squares over the steps of all runs, in shares of a run's mean step, in the terms that
/// predict the steps of runs left out best: steps of one run differ by more than runs of one
/// density do. A run without steps is one. @param runs at least one
[[nodiscard]] PeerCosts fit_costs(std::span<const MeasuredPeer> runs);

/// Of log y over log x, by least squares; 0 for fewer than two values. All above 0.
[[nodiscard]] double log_slope(std::span<const double> x, std::span<const double> y);

}  // namespace reckon::bench
