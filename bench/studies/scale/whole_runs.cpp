// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/whole_runs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "reckon/bench/studies/scale/peer_processes.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kBegin = std::chrono::seconds(1);
constexpr double kLookPeriod = 0.1;      // [s]
constexpr std::size_t kLeastRoom = 512;  // datagrams under way to a peer

std::size_t ticks_until(const ScaleSetting& setting, double time) {
  return static_cast<std::size_t>(std::llround(time * setting.rate));
}
bool is_look(const ScaleSetting& setting, std::size_t tick) {
  return tick % std::max<std::size_t>(1, ticks_until(setting, kLookPeriod)) == 0;
}

/// Of this process [octets].
double resident_memory() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident = 0;
  statm >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void summarise(WholeRun& run, const WholeSamples& samples) {
  peer::ErrorHistogram pose;
  for (const float error : samples.pose) pose.add(error);
  run.pose = pose.spread();
  peer::DurationHistogram discovery;
  for (const float after : samples.discovery) discovery.add(pdu::from_seconds(after));
  run.discovery = peer::percentiles(discovery);
}

WholeRun run_simulated(const ScaleSetting& setting, const ScaleProgress& progress) {
  const double memory = resident_memory();
  peer::ManualClock clock(kBegin, std::chrono::hours(1));
  peer::SimulatedNetworkOptions options;
  options.links = setting.peers;
  options.seed = setting.seed;
  options.datagrams_in_flight = std::max(kLeastRoom, 4 * setting.peers);
  peer::SimulatedNetwork network(options, clock);
  network.impair(setting.network);
  Crowd crowd(setting.crowd);
  std::vector<std::unique_ptr<WholePeer>> peers;
  for (std::size_t p = 0; p < setting.peers; ++p)
    peers.push_back(std::make_unique<WholePeer>(setting, p, network.link(p), clock, kBegin,
                                                static_cast<std::uint32_t>(p + 1)));
  const std::size_t warm = ticks_until(setting, setting.warm_up);
  const std::size_t ticks = warm + ticks_until(setting, setting.seconds);
  double time = 0;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    time = static_cast<double>(tick) / setting.rate;
    clock.set(kBegin + pdu::from_seconds(time));
    crowd.advance(time);
    for (const auto& peer : peers) {
      if (tick == warm) peer->begin_counting(time);
      peer->step(time, crowd);
    }
    if (is_look(setting, tick))
      for (const auto& peer : peers) peer->look(time, crowd);
    // What waits for company leaves in time, not with the next tick.
    if (setting.hold < 1 / setting.rate) {
      clock.set(kBegin + pdu::from_seconds(time + setting.hold));
      for (const auto& peer : peers) peer->serve();
    }
    if (progress && !progress(static_cast<double>(tick + 1) / static_cast<double>(ticks))) break;
  }
  WholeRun run;
  run.resident = resident_memory() - memory;
  WholeSamples samples;
  for (const auto& peer : peers) {
    run.counts.add(peer->counts(time + 1 / setting.rate));
    samples.add(peer->samples());
  }
  for (std::size_t p = 0; p < setting.peers; ++p)
    run.counts.dropped += network.link(p).statistics().queue_overflows;
  summarise(run, samples);
  return run;
}

WholeRun run_processes(const ScaleSetting& setting, Meeting meeting,
                       const ScaleProgress& progress) {
  ScaleSetting own = setting;
  // On loopback another run may have the usual port.
  if (meeting == Meeting::lo) own.port = static_cast<std::uint16_t>(20'000 + getpid() % 20'000);
  const auto task = [&](std::size_t peer, peer::Link& link, nanoseconds begin) {
    return live_for(own, peer, link, begin, {0, kWarmUp + own.seconds});
  };
  ProcessPlan plan;
  plan.count = setting.peers;
  plan.lan = meeting == Meeting::lan;
  plan.seconds = kWarmUp + setting.seconds;
  return sum_of(setting, meeting, run_peer_processes(plan, task, progress));
}

}  // namespace

void check_meeting(const ScaleSetting& setting, Meeting meeting) {
  if (meeting == Meeting::none || meeting == Meeting::simulated) return;
  if (meeting != Meeting::hosts && setting.peers > kMostProcesses)
    throw tools::UsageError(
        fmt::format("--peers: {} processes are more than one machine's network has "
                    "room for, {}; take fewer, or --whole simulated",
                    setting.peers, kMostProcesses));
  const bool is_perfect = setting.network.delay == nanoseconds(0) && setting.network.loss == 0;
  if (!is_perfect)
    throw tools::UsageError(
        "--delay, --jitter, --loss: a real network has its own; leave them out, or "
        "take --whole simulated");
  if (meeting == Meeting::lan && geteuid() != 0)
    throw tools::EnvironmentError(
        "--whole lan makes network namespaces, which needs root; run it with sudo, or "
        "take --whole lo");
}

Meeting read_meeting(const std::string& text) {
  if (text.empty()) return Meeting::none;
  if (text == "simulated") return Meeting::simulated;
  if (text == "lo") return Meeting::lo;
  if (text == "lan") return Meeting::lan;
  if (text == "hosts") return Meeting::hosts;
  throw tools::UsageError(fmt::format("--whole: '{}' is none of simulated, lo, lan, hosts", text));
}

WholeRun sum_of(const ScaleSetting& setting, Meeting meeting,
                std::span<const PeerProcess> processes) {
  WholeRun run;
  WholeSamples samples;
  run.setting = setting;
  run.meeting = meeting;
  for (const PeerProcess& process : processes) {
    run.counts.add(process.outcome.counts);
    samples.add(process.outcome.samples);
    run.resident += process.resident;
    run.latest = std::max(run.latest, process.outcome.latest);
  }
  summarise(run, samples);
  return run;
}

ScaleCounts WholeRun::as_row() const {
  ScaleCounts row;
  row.seconds = counts.seconds;
  row.peers = row.witnesses = setting.peers;
  row.entities = setting.crowd.entities;
  row.updates = counts.updates;
  row.datagrams = counts.datagrams;
  row.octets = counts.octets;
  row.heard_updates = counts.heard_updates;
  row.heard_datagrams = counts.heard_datagrams;
  row.heard_octets = counts.heard_octets;
  row.joins = counts.joins;
  row.wanted = counts.wanted;
  row.looks = counts.looks;
  row.unseen = counts.unseen;
  row.pose = pose;
  row.discovery = discovery;
  row.send_cpu = counts.cpu;
  return row;
}

WholeRun run_whole_peers(const ScaleSetting& setting, Meeting meeting,
                         const ScaleProgress& progress) {
  check_meeting(setting, meeting);
  const auto begun = std::chrono::steady_clock::now();
  WholeRun run = meeting == Meeting::simulated ? run_simulated(setting, progress)
                                               : run_processes(setting, meeting, progress);
  run.setting = setting;
  run.meeting = meeting;
  run.wall = pdu::to_seconds(std::chrono::steady_clock::now() - begun);
  return run;
}

LiveOutcome live_for(const ScaleSetting& setting, std::size_t peer, peer::Link& link,
                     nanoseconds begin, const LiveStay& stay, const AttendanceLaw& attendance) {
  const peer::SteadyClock clock;
  Crowd crowd(setting.crowd);
  std::size_t tick = ticks_until(setting, stay.from);
  const std::size_t warm =
      std::max(ticks_until(setting, kWarmUp), ticks_until(setting, stay.from + kWarmUp));
  const std::size_t end = ticks_until(setting, stay.until);
  // All processes take the same steps, so that they have the same truth.
  for (std::size_t t = 0; t <= tick; ++t) crowd.advance(static_cast<double>(t) / setting.rate);
  const auto instant = [&](std::size_t t) {
    return begin + pdu::from_seconds(static_cast<double>(t) / setting.rate);
  };
  const auto wait_for = [&](std::size_t t) {
    const nanoseconds late = clock.now() - instant(t);
    if (late < nanoseconds(0)) std::this_thread::sleep_for(-late);
    return pdu::to_seconds(std::max(late, nanoseconds(0)));
  };
  wait_for(tick);
  LiveOutcome outcome;
  const auto epoch = static_cast<std::uint32_t>(peer + 1 + 1000 * (1 + tick));
  WholePeer whole(setting, peer, link, clock, begin, epoch, attendance);
  for (; tick < end; ++tick) {
    outcome.latest = std::max(outcome.latest, wait_for(tick));
    const double time = static_cast<double>(tick) / setting.rate;
    crowd.advance(time);
    if (tick == warm) whole.begin_counting(time);
    whole.step(time, crowd);
    if (is_look(setting, tick)) whole.look(time, crowd);
  }
  outcome.counts = whole.counts(static_cast<double>(end) / setting.rate);
  outcome.samples = whole.samples();
  return outcome;
}

}  // namespace reckon::bench
