// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers as processes on several hosts: each host gets its share over ssh, and all begin together.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

/// A host, by its name for ssh.
struct ScaleHost {
  std::string name;
  std::string interface;  ///< of its peers; empty: chosen there by rule
};

/// How to reach the hosts. `ssh HOST COMMAND` must work without a prompt, and `reckon` must be in
/// the PATH of COMMAND.
struct HostsPlan {
  std::vector<ScaleHost> hosts;
  std::string ssh = "ssh -o BatchMode=yes -o ConnectTimeout=10 -o ServerAliveInterval=5";
};

/// Reads "a,b=eth1,c": hosts, some with an interface that overrides the rule.
/// @throws UsageError for an invalid or repeated host
[[nodiscard]] std::vector<ScaleHost> read_hosts(std::string_view text);

/// @throws UsageError with the remedy if the exercise cannot run on these hosts
void check_hosts(const ScaleSetting& setting, const HostsPlan& plan);

/// The command that runs a host's peers. Its flags give the host the same setting.
[[nodiscard]] std::string share_command(const ScaleSetting& setting, const ScaleHost& host,
                                        std::size_t first, std::size_t end);

/// Runs the exercise, as run_whole_peers() does. The begin of a host is late by the time that ssh
/// needs to deliver the word, less half of the round trip measured before. @throws EnvironmentError
/// with the host's name if it is unreachable, has no reckon or another version, cannot use its
/// interface, or ends early
[[nodiscard]] WholeRun run_on_hosts(const ScaleSetting& setting, const HostsPlan& plan,
                                    const ScaleProgress& progress = {});

}  // namespace reckon::bench
