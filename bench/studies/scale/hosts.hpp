// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers as processes of several hosts: each host is given its share over ssh, all begin together.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

/// A host as ssh knows it.
struct ScaleHost {
  std::string name;
  std::string interface;  ///< that its peers use; empty: chosen there by rule
};

/// How to get there. `ssh HOST COMMAND` has to work without a question, and `reckon` has to be in
/// the PATH of such a command.
struct HostsPlan {
  std::vector<ScaleHost> hosts;
  std::string ssh = "ssh -o BatchMode=yes -o ConnectTimeout=10 -o ServerAliveInterval=5";
};

/// "a,b=eth1,c": hosts, with the interface where the rule is not to choose. @throws UsageError for
/// a name that is none, or comes twice
[[nodiscard]] std::vector<ScaleHost> read_hosts(std::string_view text);

/// @throws UsageError where these hosts cannot have so many peers, with the remedy
void check_hosts(const ScaleSetting& setting, const HostsPlan& plan);

/// The command that a host is given: its peers of the exercise, so that all words of the setting
/// come to the same there.
[[nodiscard]] std::string share_command(const ScaleSetting& setting, const ScaleHost& host,
                                        std::size_t first, std::size_t end);

/// Runs the exercise, as run_whole_peers() does. All begin within the time that ssh needs for a
/// word, less half of what a word and its answer took before. @throws EnvironmentError, naming the
/// host, where one cannot be reached, has no reckon or another one, cannot use its interface, or
/// ends early
[[nodiscard]] WholeRun run_on_hosts(const ScaleSetting& setting, const HostsPlan& plan,
                                    const ScaleProgress& progress = {});

}  // namespace reckon::bench
