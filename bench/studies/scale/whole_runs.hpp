// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// All peers of an exercise: in one process and simulated time, or each a process of its own on a
// real network of this machine.
#pragma once

#include <chrono>
#include <functional>
#include <span>
#include <string>

#include "reckon/bench/studies/scale/whole_peer.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::bench {

/// Takes the share of the run that is done; false ends it.
using ScaleProgress = std::function<bool(double share)>;

/// Where peers meet.
enum class Meeting : std::uint8_t {
  simulated,  ///< one process, simulated time
  lo,         ///< processes on loopback
  lan,        ///< processes in network namespaces of their own, on a bridge that snoops; root
  hosts,      ///< processes on several hosts, started over ssh
};
/// "lo", "lan" or "hosts"; empty: simulated. @throws UsageError for other words
[[nodiscard]] Meeting read_meeting(const std::string& text);
/// @throws UsageError or EnvironmentError where these peers cannot meet there, with the remedy
void check_meeting(const ScaleSetting& setting, Meeting meeting);

/// What all peers of an exercise counted.
struct WholeRun {
  ScaleSetting setting;
  Meeting meeting = Meeting::simulated;
  WholeCounts counts;
  peer::Spread pose;            ///< [m]
  peer::Percentiles discovery;  ///< from coming into the radius until shown
  double resident = 0;          ///< memory, of all [octets]
  double wall = 0;              ///< [s] that it took
  double latest = 0;            ///< [s] by which the latest step of a process was late
  /// Of all, in a kernel that their simulated network lacks [s]; to be filled in.
  double kernel_cpu = 0;
};

/// Most peers that may be processes of this machine.
inline constexpr std::size_t kMostProcesses = 250;

/// Simulated ones are the same every time but for the CPU. @param meeting not hosts @throws what
/// check_scale_setting() and check_meeting() do, EnvironmentError where a process ends early
[[nodiscard]] WholeRun run_whole_peers(const ScaleSetting& setting, Meeting meeting,
                                       const ScaleProgress& progress = {});

/// One real peer from `from` until `until` [s since begin], at the setting's ticks, by the host's
/// clock. It counts from kWarmUp after its coming, or the exercise's. @param begin steady time
struct LiveStay {
  double from = 0, until = 0;
};
struct LiveOutcome {
  WholeCounts counts;
  WholeSamples samples;
  double latest = 0;  ///< [s] by which the latest tick was late
};
/// How the process of a peer ended.
struct PeerProcess {
  LiveOutcome outcome;
  double resident = 0;  ///< memory of its own [octets]
};
/// What they came to together.
[[nodiscard]] WholeRun sum_of(const ScaleSetting& setting, Meeting meeting,
                              std::span<const PeerProcess> processes);

[[nodiscard]] LiveOutcome live_for(const ScaleSetting& setting, std::size_t peer, peer::Link& link,
                                   std::chrono::nanoseconds begin, const LiveStay& stay,
                                   const AttendanceLaw& attendance = {});

}  // namespace reckon::bench
