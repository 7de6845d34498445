// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers as processes of this machine: on loopback, on an interface, or on a LAN of network
// namespaces. The namespaces end with the processes: nothing has to be cleaned up.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/whole_runs.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::bench {

/// The work of a process from `begin` on [steady time, the same for all].
using PeerTask =
    std::function<LiveOutcome(std::size_t peer, peer::Link& link, std::chrono::nanoseconds begin)>;

/// Which processes, and where.
struct ProcessPlan {
  std::size_t first = 0, count = 0;  ///< number of the first peer; count: 1 .. kMostProcesses
  /// Each process has a network namespace with an interface e0 on one bridge. The bridge has an
  /// IGMP querier and snoops, so it floods nothing. Needs root.
  bool lan = false;
  std::string interface = "lo";  ///< without `lan`; empty: chosen by rule
  double seconds = 0;            ///< duration of the task
  /// Called when all processes are ready. Returns the steady time of the begin; none ends the run.
  /// Default: time_to_begin() later.
  std::function<std::optional<std::chrono::nanoseconds>()> begin = {};
};

/// Time that so many processes need before the begin to open their sockets.
[[nodiscard]] std::chrono::nanoseconds time_to_begin(std::size_t processes) noexcept;

/// Forks the processes and waits for them. @return by peer; empty if `progress` or `begin` ended
/// the run  @throws EnvironmentError if the network cannot be created, or a process ends early
[[nodiscard]] std::vector<PeerProcess> run_peer_processes(const ProcessPlan& plan,
                                                          const PeerTask& task,
                                                          const ScaleProgress& progress = {});

}  // namespace reckon::bench
