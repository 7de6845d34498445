// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/whole_runs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <thread>

#include "reckon/bench/studies/scale/peer_processes.hpp"
#include "reckon/pdu/random/split_mix.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer_threads.hpp"
#include "reckon/peer/threads/cpu_time.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kExerciseBegin = std::chrono::seconds(1);
constexpr double kLookPeriod = 0.1;      // [s]
constexpr double kPassGrid = 0.00025;    // [s], of the passes of simulated peers
constexpr std::size_t kLeastRoom = 512;  // datagrams in flight to a peer
constexpr double kLatest = 0.0005;       // [s], of a tick of a simulated peer
constexpr double kComing = 1;            // [s] in which all peers of a simulated network join
constexpr double kOffTick = 0.37;        // of the time from one joining peer to the next

std::size_t ticks_until(const ScaleSetting& setting, double time) {
  return static_cast<std::size_t>(std::llround(time * setting.rate));
}
bool is_look(const ScaleSetting& setting, std::size_t tick) {
  return tick % std::max<std::size_t>(1, ticks_until(setting, kLookPeriod)) == 0;
}

/// Resident memory of this process [octets].
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

/// The peers of one simulated network. Each link has room for room_of() datagrams in flight.
class SimulatedPeers {
 public:
  SimulatedPeers(const ScaleSetting& setting, const peer::Clock& clock)
      : setting_(setting),
        clock_(clock),
        room_(room_of(setting)),
        network_(options_of(setting, room_), clock) {
    network_.impair(setting.network);
  }

  /// Each peer passes if its model loop would. Peers join one after the other, and not at a tick;
  /// else all would repeat their states at the same instants, together with a tick.
  void pass(double time) {
    const double come = time / kComing * static_cast<double>(setting_.peers) - kOffTick;
    for (std::size_t p = peers_.size(); p < setting_.peers && static_cast<double>(p) <= come; ++p)
      peers_.push_back(std::make_unique<WholePeer>(
          setting_, p, network_.link(p), clock_, kExerciseBegin, static_cast<std::uint32_t>(p + 1),
          peer::FederateLoops::in_step));
    for_each([](WholePeer& peer) {
      if (peer.is_due()) peer.serve();
    });
  }
  /// Calls use(peer) for each joined peer. When many datagrams are in flight, all peers read them,
  /// so that no link overflows.
  template <typename Use>
  void for_each(Use&& use) {
    for (std::size_t p = 0; p < peers_.size(); ++p) {
      const std::uint64_t before = network_.link(p).statistics().sent;
      use(*peers_[p]);
      under_way_ += network_.link(p).statistics().sent - before;
      if (2 * under_way_ > room_) serve();
    }
  }
  /// All peers send due datagrams and read arrived ones.
  void serve() {
    under_way_ = 0;
    for_each([](WholePeer& peer) { peer.serve(); });
  }
  [[nodiscard]] std::uint64_t overflows() {
    std::uint64_t sum = 0;
    for (std::size_t p = 0; p < peers_.size(); ++p)
      sum += network_.link(p).statistics().queue_overflows;
    return sum;
  }

 private:
  static std::size_t room_of(const ScaleSetting& setting) {
    const std::size_t own = setting.crowd.entities / setting.peers + 1;
    const double at_once = static_cast<double>(setting.peers) / (kComing * setting.rate);
    return std::max({kLeastRoom, 4 * setting.peers,
                     2 * own * (1 + static_cast<std::size_t>(std::ceil(at_once)))});
  }
  static peer::SimulatedNetworkOptions options_of(const ScaleSetting& setting, std::size_t room) {
    peer::SimulatedNetworkOptions options;
    options.links = setting.peers;
    options.seed = setting.seed;
    options.datagrams_in_flight = room;
    options.join_delay = pdu::from_seconds(setting.join);
    return options;
  }

  const ScaleSetting& setting_;
  const peer::Clock& clock_;
  std::size_t room_;
  peer::SimulatedNetwork network_;
  std::vector<std::unique_ptr<WholePeer>> peers_;
  std::uint64_t under_way_ = 0;
};

WholeRun run_simulated(const ScaleSetting& setting, const ScaleProgress& progress) {
  const double memory = resident_memory();
  peer::ManualClock clock(kExerciseBegin, std::chrono::hours(1));
  SimulatedPeers peers(setting, clock);
  Crowd crowd(setting.crowd);
  const std::size_t warm = ticks_until(setting, kWarmUp);
  const std::size_t ticks = warm + ticks_until(setting, setting.seconds);
  double time = 0;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    time = static_cast<double>(tick) / setting.rate;
    // A live program states the motion a little late. Without that, deadlines would fall on ticks.
    const double late = kLatest * pdu::unit_of(pdu::split_mix(setting.seed + tick));
    clock.set(kExerciseBegin + pdu::from_seconds(time + late));
    crowd.advance(time);
    if (tick == warm) peers.for_each([&](WholePeer& peer) { peer.begin_counting(time); });
    peers.for_each([&](WholePeer& peer) { peer.step(time, crowd); });
    if (is_look(setting, tick)) peers.for_each([&](WholePeer& peer) { peer.look(time, crowd); });
    for (double at = time + kLatest; at < time + 1 / setting.rate; at += kPassGrid) {
      clock.set(kExerciseBegin + pdu::from_seconds(at));
      peers.pass(at);
    }
    if (progress && !progress(static_cast<double>(tick + 1) / static_cast<double>(ticks))) break;
  }
  WholeRun run;
  run.resident = resident_memory() - memory;
  WholeSamples samples;
  peers.for_each([&](WholePeer& peer) {
    run.counts.add(peer.counts(time + 1 / setting.rate));
    samples.add(peer.samples());
  });
  run.counts.dropped += peers.overflows();
  summarise(run, samples);
  return run;
}

WholeRun run_processes(const ScaleSetting& setting, Meeting meeting,
                       const ScaleProgress& progress) {
  ScaleSetting own = setting;
  // Another run on loopback may use the default port.
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
  if (meeting == Meeting::simulated) return;
  if (meeting != Meeting::hosts && setting.peers > kMostProcesses)
    throw tools::UsageError(fmt::format(
        "--peers: {} processes exceed the {} of one machine's network; lower it, or remove --whole",
        setting.peers, kMostProcesses));
  const bool is_perfect = setting.network.delay == nanoseconds(0) && setting.network.loss == 0;
  if (!is_perfect)
    throw tools::UsageError(
        "--delay, --jitter, --loss: a real network has its own; remove them, or --whole and "
        "--pick");
  if (meeting == Meeting::lan && geteuid() != 0)
    throw tools::EnvironmentError(
        "--whole lan creates network namespaces, which needs root; run it with sudo, or write "
        "--whole lo");
}

Meeting read_meeting(const std::string& text) {
  if (text.empty()) return Meeting::simulated;
  if (text == "lo") return Meeting::lo;
  if (text == "lan") return Meeting::lan;
  if (text == "hosts") return Meeting::hosts;
  throw tools::UsageError(fmt::format("--whole: '{}' is not one of lo, lan, hosts", text));
}

CostCounts cost_counts(const WholeRun& run) noexcept {
  const WholeCounts& counts = run.counts;
  const double seconds = counts.seconds * static_cast<double>(run.setting.peers);
  const auto passes = static_cast<double>(counts.passes);
  const double wakes = std::min(passes, seconds / pdu::to_seconds(peer::kTogether));
  return {wakes,
          passes - wakes,
          static_cast<double>(counts.heard_datagrams),
          static_cast<double>(counts.datagrams),
          run.setting.rate * seconds,
          static_cast<double>(counts.joins)};
}

double live_cpu(const CostCounts& counts, const LiveCosts& costs) noexcept {
  return std::inner_product(counts.begin(), counts.end(), costs.begin(), 0.0);
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

WholeRun run_whole_peers(const ScaleSetting& setting, Meeting meeting,
                         const ScaleProgress& progress) {
  check_scale_setting(setting);
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
  const std::size_t warm = std::max(ticks_until(setting, stay.settling),
                                    ticks_until(setting, stay.from + stay.settling));
  const std::size_t end = ticks_until(setting, stay.until);
  // All processes take the same steps, so that their true positions are equal.
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
  WholePeer whole(setting, peer, link, clock, begin, epoch, peer::FederateLoops::threads,
                  attendance);
  nanoseconds before{0}, of_study{0};  // CPU time
  const auto apart = [&](auto&& work) {
    const nanoseconds begun = peer::thread_cpu_time();
    work();
    of_study += peer::thread_cpu_time() - begun;
  };
  for (; tick < end; ++tick) {
    outcome.latest = std::max(outcome.latest, wait_for(tick));
    const double time = static_cast<double>(tick) / setting.rate;
    apart([&] { crowd.advance(time); });
    if (tick == warm) {
      whole.begin_counting(time);
      before = peer::process_cpu_time();
      of_study = nanoseconds(0);
    }
    whole.step(time, crowd);
    if (is_look(setting, tick)) apart([&] { whole.look(time, crowd); });
  }
  const nanoseconds spent = peer::process_cpu_time() - before - of_study;
  outcome.counts = whole.counts(static_cast<double>(end) / setting.rate);
  outcome.counts.cpu = pdu::to_seconds(spent);
  outcome.samples = whole.samples();
  return outcome;
}

}  // namespace reckon::bench
