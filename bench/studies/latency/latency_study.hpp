// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How long a change of the force between two hands is under way from servo to servo, with threads
// and sockets as in a running peer, and beside it a bare UDP ping over the same interface in turn.
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
  std::string key;  ///< key file, of a touch that is sealed; empty: plain
  std::chrono::nanoseconds length = std::chrono::seconds(60);
  std::uint64_t seed = 1;   ///< of jumps and pauses
  bool touch_tier = false;  ///< the touch goes by groups of its own
};

/// Hands have to meet first, and one round takes its time.
inline constexpr std::chrono::nanoseconds kShortestLatencyStudy = std::chrono::seconds(4);

/// What was measured.
struct Latencies {
  std::vector<std::chrono::nanoseconds> there, there_and_back;  ///< of the ping
  std::vector<std::chrono::nanoseconds> touch;
  /// From each servo step to the next, of both peers: what the machine itself holds up shows here.
  std::vector<std::chrono::nanoseconds> servo_steps;
  std::size_t missed = 0;   ///< changes that did not show in time
  bool real_time = true;    ///< whether both servos had SCHED_FIFO
  double cpu_seconds = 0;   ///< of the whole process, while the peers ran
  double peer_seconds = 0;  ///< time that they ran
  std::uint64_t felt = 0;   ///< updates that went by contact groups

  /// Share of a core.
  [[nodiscard]] double cpu_of_peer() const {
    return peer_seconds > 0 ? 0.5 * cpu_seconds / peer_seconds : 0.0;
  }
};

/// Percentiles [us].
[[nodiscard]] peer::Spread spread_us(std::vector<std::chrono::nanoseconds> times);

/// Runs for options.length, in rounds of pings and touches; the servos pass through all phases of
/// each other. Ends early when the console is stopped.
/// @throws std::runtime_error where the interface or its sockets cannot be had.
[[nodiscard]] Latencies measure_latency(const LatencyOptions& options,
                                        const tools::Console& console);

}  // namespace reckon::bench
