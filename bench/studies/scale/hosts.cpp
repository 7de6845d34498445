// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/hosts.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "reckon/bench/studies/scale/host_lines.hpp"
#include "reckon/bench/studies/scale/peer_processes.hpp"
#include "reckon/bench/studies/scale/remote_command.hpp"
#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/version.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr int kClocks = 9;                   // round trips; the fastest counts
constexpr double kAnswer = 60, kSlack = 30;  // [s], for an answer, after the end

/// A host with a running command.
struct Remote {
  const ScaleHost& host;
  std::size_t first, end;  // peers
  RemoteCommand command;
};

/// The error for a command that ended. @param status of ssh, its shell or reckon, or 128 + signal
tools::EnvironmentError failed(const ScaleHost& host, const std::string& ssh, int status) {
  constexpr int kNotReached = 255, kNotFound = 127, kUsage = 2, kEnvironment = 3;
  std::string why = fmt::format("ended early, with status {} (its output is above)", status);
  if (status == kNotReached)
    why = fmt::format(
        "cannot be reached; `{} {} true` must work without a question (its output is above)", ssh,
        host.name);
  if (status == kNotFound)
    why =
        "has no reckon in the PATH of `ssh HOST COMMAND`; install it there, e.g. in /usr/local/bin";
  if (status == kUsage)
    why = "has an incompatible reckon (its output is above); install the same version";
  if (status == kEnvironment)
    why = fmt::format(
        "cannot use its network (its output is above); write its interface: --hosts {}=NAME",
        host.name);
  return tools::EnvironmentError(fmt::format("host {}: {}", host.name, why));
}

tools::EnvironmentError silent(const ScaleHost& host) {
  return tools::EnvironmentError(fmt::format("host {}: does not answer", host.name));
}

/// The next line of a host. @throws EnvironmentError if none arrives
std::string answer_of(Remote& remote, const std::string& ssh) {
  const auto deadline = peer::SteadyClock().now() + pdu::from_seconds(kAnswer);
  auto line = remote.command.read_line([&] { return peer::SteadyClock().now() < deadline; });
  if (line) return *line;
  if (!remote.command.has_ended()) throw silent(remote.host);
  throw failed(remote.host, ssh, remote.command.status());
}

void check_versions(const HostsPlan& plan) {
  std::vector<std::unique_ptr<Remote>> all;
  for (const ScaleHost& host : plan.hosts)
    all.push_back(std::make_unique<Remote>(
        Remote{host, 0, 0, RemoteCommand(plan.ssh, host.name, "reckon --version")}));
  for (const auto& remote : all) {
    const std::string found = answer_of(*remote, plan.ssh);
    const std::string wanted = fmt::format("reckon {}", tools::program_version());
    if (found != wanted)
      throw tools::EnvironmentError(
          fmt::format("host {}: has '{}', but this host '{}'; install the same version",
                      remote->host.name, found, wanted));
  }
}

/// Starts the shares and waits until all processes are ready.
std::vector<std::unique_ptr<Remote>> start(const ScaleSetting& setting, const HostsPlan& plan) {
  std::vector<std::unique_ptr<Remote>> all;
  const std::size_t hosts = plan.hosts.size();
  for (std::size_t i = 0; i < hosts; ++i) {
    const std::size_t first = i * setting.peers / hosts, end = (i + 1) * setting.peers / hosts;
    const std::string command = share_command(setting, plan.hosts[i], first, end);
    all.push_back(std::make_unique<Remote>(
        Remote{plan.hosts[i], first, end, RemoteCommand(plan.ssh, plan.hosts[i].name, command)}));
  }
  const std::uint64_t scene = scale_scene(setting).hash;
  for (const auto& remote : all)
    if (read_ready_line(answer_of(*remote, plan.ssh)) != scene)
      throw tools::EnvironmentError(
          fmt::format("host {}: its reckon creates a different exercise, although its version is "
                      "also {}; install the same build",
                      remote->host.name, tools::program_version()));
  return all;
}

/// Half of the shortest round trip.
nanoseconds way_to(Remote& remote, const std::string& ssh) {
  const peer::SteadyClock clock;
  nanoseconds least = nanoseconds::max();
  for (int i = 0; i < kClocks; ++i) {
    const nanoseconds asked = clock.now();
    remote.command.write_line(kClockWord);
    if (answer_of(remote, ssh) != kClockLine) throw silent(remote.host);
    least = std::min(least, clock.now() - asked);
  }
  return least / 2;
}

/// Reads the results of a host's peers. False if stopped.
bool gather(Remote& remote, const std::string& ssh, std::vector<PeerProcess>& processes,
            const std::function<bool()>& go_on, nanoseconds deadline) {
  for (std::size_t expected = remote.first; expected < remote.end; ++expected) {
    bool stopped = false;
    const auto line = remote.command.read_line([&] {
      stopped = !go_on();
      return !stopped && peer::SteadyClock().now() < deadline;
    });
    if (stopped) return false;
    if (!line && !remote.command.has_ended()) throw silent(remote.host);
    if (!line) throw failed(remote.host, ssh, remote.command.status());
    std::size_t peer = 0;
    if (!read_peer_line(*line, peer, processes[expected]) || peer != expected)
      throw tools::EnvironmentError(fmt::format("host {}: its result of peer {} is malformed",
                                                remote.host.name, expected + 1));
  }
  return true;
}

}  // namespace

std::vector<ScaleHost> read_hosts(std::string_view text) {
  std::vector<ScaleHost> hosts;
  for (const std::string_view part : parts_between_commas(text)) {
    const auto equals = part.find('=');
    ScaleHost host{std::string(part.substr(0, equals)),
                   equals == part.npos ? "" : std::string(part.substr(equals + 1))};
    // ssh would read a name with a leading dash as an option.
    if (host.name.empty() || host.name.starts_with('-') ||
        (equals != part.npos && host.interface.empty()))
      throw tools::UsageError(fmt::format(
          "--hosts: '{}' is neither HOST nor HOST=INTERFACE; write for example --hosts a,b=eth1",
          part));
    if (std::ranges::count(hosts, host.name, &ScaleHost::name) > 0)
      throw tools::UsageError(fmt::format("--hosts: '{}' appears twice; remove one", host.name));
    hosts.push_back(std::move(host));
  }
  return hosts;
}

void check_hosts(const ScaleSetting& setting, const HostsPlan& plan) {
  if (plan.hosts.empty())
    throw tools::UsageError("--whole hosts needs hosts, for example --hosts a,b=eth1");
  const std::size_t hosts = plan.hosts.size();
  if (setting.peers < hosts)
    throw tools::UsageError(
        fmt::format("--peers: {} leave some of {} hosts without a peer; write {} or more",
                    setting.peers, hosts, hosts));
  if (setting.peers > hosts * kMostProcesses)
    throw tools::UsageError(fmt::format("--peers: {} are more than {} a host; add --hosts",
                                        setting.peers, kMostProcesses));
  if (!setting.crowd.tracks.empty())
    throw tools::UsageError("--whole hosts: FILE exists only on this host; remove it");
}

std::string share_command(const ScaleSetting& setting, const ScaleHost& host, std::size_t first,
                          std::size_t end) {
  const std::string interface =
      host.interface.empty() ? "" : "=" + quoted_for_shell(host.interface);
  return fmt::format(
      "reckon bench scale --share {}-{}{} --peers {} --entities {} --movement {} --density {} "
      "--radius {}m --scheme {} --cell {}m --pool {} --rate {} --threshold {}m --seed {} --for "
      "{}ns --port {}",
      first + 1, end, interface, setting.peers, setting.crowd.entities, setting.crowd.movement,
      setting.crowd.density, setting.radius, peer::word_of(setting.grid.scheme),
      setting.grid.cell_size, setting.grid.pool, setting.rate, setting.thresholds.position,
      setting.seed, pdu::from_seconds(setting.seconds).count(), setting.port);
}

WholeRun run_on_hosts(const ScaleSetting& setting, const HostsPlan& plan,
                      const ScaleProgress& progress) {
  check_hosts(setting, plan);
  const peer::SteadyClock clock;
  const nanoseconds begun = clock.now();
  ScaleSetting own = setting;
  own.port = static_cast<std::uint16_t>(20'000 + getpid() % 20'000);  // avoids other runs' ports
  check_versions(plan);
  const auto all = start(own, plan);
  std::vector<nanoseconds> ways;
  for (const auto& remote : all) ways.push_back(way_to(*remote, plan.ssh));
  const std::size_t most = (setting.peers + all.size() - 1) / all.size();
  const nanoseconds begin = clock.now() + time_to_begin(most);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i]->command.write_line(begin_word(begin - clock.now() - ways[i]));

  const double seconds = kWarmUp + setting.seconds;
  const auto go_on = [&] {
    const double share = pdu::to_seconds(clock.now() - begin) / seconds;
    return !progress || progress(std::clamp(share, 0.0, 1.0));
  };
  std::vector<PeerProcess> processes(setting.peers);
  for (const auto& remote : all)
    if (!gather(*remote, plan.ssh, processes, go_on, begin + pdu::from_seconds(seconds + kSlack)))
      return sum_of(setting, Meeting::hosts, {});
  WholeRun run = sum_of(setting, Meeting::hosts, processes);
  run.wall = pdu::to_seconds(clock.now() - begun);
  return run;
}

}  // namespace reckon::bench
