// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Latency of a change of the force between two hands from servo to servo, with threads and sockets
// as in a running peer. A bare UDP ping over the same interface is measured in alternation.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// What to measure.
struct LatencyOptions {
  std::string iface = "lo";
  std::string key;  ///< key file for a sealed touch; empty: plain DIS
  std::chrono::nanoseconds length = std::chrono::seconds(60);
  std::uint64_t seed = 1;   ///< of jumps and pauses
  bool touch_tier = false;  ///< the touch is sent to groups of its own
};

/// The hands have to meet first, and one round takes several seconds.
inline constexpr std::chrono::nanoseconds kShortestLatencyStudy = std::chrono::seconds(4);

/// Results of the measurement.
struct Latencies {
  std::vector<std::chrono::nanoseconds> there, there_and_back;  ///< of the ping
  std::vector<std::chrono::nanoseconds> touch;
  /// Time from each servo step to the next, of both peers: it shows delays of the machine itself.
  std::vector<std::chrono::nanoseconds> servo_steps;
  std::size_t missed = 0;   ///< changes that did not appear in time
  bool real_time = true;    ///< whether both servos had SCHED_FIFO
  double cpu_seconds = 0;   ///< of the whole process while the peers ran
  double peer_seconds = 0;  ///< time during which they ran
  std::uint64_t felt = 0;   ///< updates received through contact groups

  /// CPU as a share of a core.
  [[nodiscard]] double cpu_of_peer() const {
    return peer_seconds > 0 ? 0.5 * cpu_seconds / peer_seconds : 0.0;
  }
};

/// Percentiles [us].
[[nodiscard]] peer::Spread spread_us(std::vector<std::chrono::nanoseconds> times);

/// Runs for options.length, in rounds of pings and touches; the servos pass through all phases
/// relative to each other. Ends early if the console is stopped.
/// @throws std::runtime_error if the interface or its sockets are not available.
[[nodiscard]] Latencies measure_latency(const LatencyOptions& options,
                                        const tools::Console& console);

}  // namespace reckon::bench
