// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// All peers of an exercise whole: in one process and simulated time, or each a process of its own
// on a real network of this machine.
#pragma once

#include <chrono>
#include <span>
#include <string>

#include "reckon/bench/studies/scale/text.hpp"
#include "reckon/bench/studies/scale/whole_peer.hpp"
#include "reckon/bench/studies/scale/world.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::bench {

/// Where whole peers meet.
enum class Meeting : std::uint8_t {
  none,       ///< no whole peers
  simulated,  ///< one process, simulated time
  lo,         ///< processes on loopback
  lan,        ///< processes in network namespaces of their own, on a bridge that snoops; root
  hosts,      ///< processes on several hosts, started over ssh
};
/// "simulated", "lo", "lan" or "hosts". @throws UsageError for other words
[[nodiscard]] Meeting read_meeting(const std::string& text);
/// @throws UsageError or EnvironmentError where these peers cannot meet there, with the remedy
void check_meeting(const ScaleSetting& setting, Meeting meeting);

/// What all whole peers of an exercise counted.
struct WholeRun {
  ScaleSetting setting;
  Meeting meeting = Meeting::none;
  WholeCounts counts;
  peer::Spread pose;            ///< [m]
  peer::Percentiles discovery;  ///< from coming into the radius until shown
  double resident = 0;          ///< memory, of all [octets]
  double wall = 0;              ///< [s] that it took
  double latest = 0;            ///< [s] by which the latest step of a process was late

  /// As far as it can be said, what the light peers' row says.
  [[nodiscard]] ScaleCounts as_row() const;
};

/// Most peers that may be processes of this machine.
inline constexpr std::size_t kMostProcesses = 250;

/// @param meeting neither none nor hosts @throws what check_meeting() does, EnvironmentError where
/// a process ends early
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
