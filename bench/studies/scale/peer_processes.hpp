// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers as processes of this machine: on loopback, on an interface, or on a LAN made of network
// namespaces. All that
// is made goes with the processes: nothing has to be cleaned up.
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

/// What a process does between `begin` [steady time, the same of all] and its end.
using PeerTask =
    std::function<LiveOutcome(std::size_t peer, peer::Link& link, std::chrono::nanoseconds begin)>;

/// Which processes, and where.
struct ProcessPlan {
  std::size_t first = 0, count = 0;  ///< numbers of the peers; 1 .. kMostProcesses
  /// Each in a network namespace with an interface e0 on one bridge, which asks who has joined what
  /// and floods nothing; root.
  bool lan = false;
  std::string interface = "lo";  ///< of those that are not; empty: chosen by rule
  double seconds = 0;            ///< that the task takes
  /// Asked once all are there: steady time of the begin; none: end. Default: a moment later.
  std::function<std::optional<std::chrono::nanoseconds>()> begin = {};
};

/// From the word to begin until the begin, time for so many processes to open their sockets.
[[nodiscard]] std::chrono::nanoseconds time_to_begin(std::size_t processes) noexcept;

/// Forks the processes and waits for them. @return by peer; nothing where progress or `begin` ended
/// it @throws EnvironmentError where the network cannot be made, or a process ends early
[[nodiscard]] std::vector<PeerProcess> run_peer_processes(const ProcessPlan& plan,
                                                          const PeerTask& task,
                                                          const ScaleProgress& progress = {});

}  // namespace reckon::bench
