// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers as processes of this machine, on loopback or on a LAN made of network namespaces. All that
// is made goes with the processes: nothing has to be cleaned up.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

#include "reckon/peer/network/link.hpp"
#include "reckon/tools/studies/scale/whole_runs.hpp"
#include "reckon/tools/studies/scale/world.hpp"

namespace reckon::tools {

/// What a process does between `begin` [steady time, the same of all] and its end.
using PeerTask =
    std::function<LiveOutcome(std::size_t peer, peer::Link& link, std::chrono::nanoseconds begin)>;

/// How one ended.
struct PeerProcess {
  LiveOutcome outcome;
  double resident = 0;  ///< memory of its own [octets]
};

/// Forks `peers` processes, 1 .. kMostProcesses, and waits for them. With `lan` each has a network
/// namespace with an interface e0 on one bridge, which asks who has joined what and floods nothing;
/// else all are on lo. @param seconds that the task takes @return by peer; nothing where progress
/// ended it @throws EnvironmentError where the network cannot be made, or a process ends early
[[nodiscard]] std::vector<PeerProcess> run_peer_processes(std::size_t peers, bool lan,
                                                          double seconds, const PeerTask& task,
                                                          const ScaleProgress& progress = {});

}  // namespace reckon::tools
