// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// All peers of an exercise: in one process and simulated time, or as processes on a real network.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "reckon/bench/studies/scale/whole_peer.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::bench {

/// Receives the completed share of the run; false ends the run.
using ScaleProgress = std::function<bool(double share)>;

/// The network between the peers.
enum class Meeting : std::uint8_t {
  simulated,  ///< one process, simulated time
  lo,         ///< processes on loopback
  lan,        ///< processes in network namespaces on a snooping bridge; needs root
  hosts,      ///< processes on several hosts, started over ssh
};
/// "lo", "lan" or "hosts"; empty: simulated. @throws UsageError for other words
[[nodiscard]] Meeting read_meeting(const std::string& text);
/// @throws UsageError or EnvironmentError with the remedy if the exercise cannot run there
void check_meeting(const ScaleSetting& setting, Meeting meeting);

/// What costs a live peer CPU time beside its loops in simulated time, system calls included.
inline constexpr std::array<std::string_view, 6> kCostNames{"wake", "pass", "heard",
                                                            "sent", "tick", "join"};
/// Times that all peers of a run did each. A wake is a pass of the model loop, one each
/// peer::kTogether at most; `pass` are those beyond, without a sleep before. Heard and sent:
/// datagrams. Tick: of the program that states the motion of its entities. Join: of a group.
using CostCounts = std::array<double, kCostNames.size()>;
/// CPU time of each [s].
using LiveCosts = std::array<double, kCostNames.size()>;

/// Results of all peers of an exercise.
struct WholeRun {
  ScaleSetting setting;
  Meeting meeting = Meeting::simulated;
  WholeCounts counts;
  peer::Spread pose;            ///< error of shown positions [m]
  peer::Percentiles discovery;  ///< from entering the radius until shown
  double resident = 0;          ///< memory of all peers [octets]
  double wall = 0;              ///< duration of the run [s]
  double latest = 0;            ///< largest delay of a step of a process [s]
  /// CPU time of all live peers beside their loops [s]: predicted for a simulated run by the
  /// caller, else 0.
  double live_cpu = 0;
  LiveCosts costs{};  ///< of the prediction

  /// Of a core, on average over the peers.
  [[nodiscard]] double cpu_share() const noexcept {
    return (counts.cpu + live_cpu) / counts.seconds / static_cast<double>(setting.peers);
  }
};

[[nodiscard]] CostCounts cost_counts(const WholeRun& run) noexcept;
/// Of all peers beside their loops [s].
[[nodiscard]] double live_cpu(const CostCounts& counts, const LiveCosts& costs) noexcept;

/// Most peers as processes of one machine.
inline constexpr std::size_t kMostProcesses = 250;

/// Simulated runs repeat exactly, except for CPU times. @param meeting not hosts  @throws as
/// check_scale_setting() and check_meeting() do; EnvironmentError if a process ends early
[[nodiscard]] WholeRun run_whole_peers(const ScaleSetting& setting, Meeting meeting,
                                       const ScaleProgress& progress = {});

/// When a real peer takes part [s since begin].
struct LiveStay {
  double from = 0, until = 0;
  double settling = kWarmUp;  ///< not counted
};
struct LiveOutcome {
  WholeCounts counts;
  WholeSamples samples;
  double latest = 0;  ///< largest delay of a tick [s]
};
/// Result of a peer's process.
struct PeerProcess {
  LiveOutcome outcome;
  double resident = 0;  ///< memory of the process alone [octets]
};
/// The results of all processes together.
[[nodiscard]] WholeRun sum_of(const ScaleSetting& setting, Meeting meeting,
                              std::span<const PeerProcess> processes);

/// Runs one real peer during `stay` at the setting's ticks, by the host's clock. It counts from
/// `stay.settling` after it joins, or after the begin if that is later. @param begin steady time
[[nodiscard]] LiveOutcome live_for(const ScaleSetting& setting, std::size_t peer, peer::Link& link,
                                   std::chrono::nanoseconds begin, const LiveStay& stay,
                                   const AttendanceLaw& attendance = {});

}  // namespace reckon::bench
