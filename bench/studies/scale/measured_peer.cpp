// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/measured_peer.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "reckon/bench/studies/scale/thread_cpu.hpp"
#include "reckon/bench/studies/scale/whole_peer.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kBegin = std::chrono::seconds(1);
constexpr std::size_t kPeersOfAddress = 60;  // a peer keeps 64 of one address and port in mind
constexpr std::size_t kInFlight = 16'384;    // datagrams towards it within a tick
constexpr int kTurns = 15;                   // of which, step by step, the least counts
constexpr std::uint16_t kOwnSite = 2;        // the light peers have 1
constexpr std::uint32_t kOwnEpoch = 0x7fff0001;

/// The peer and the network around it.
class Bystander {
 public:
  Bystander(const ScaleSetting& setting, const peer::SceneFile& scene)
      : pool_(peer::pool_of(scene)),
        clock_(kBegin, std::chrono::hours(1)),
        network_(options_of(setting), clock_),
        joined_(federate(scene), network_.link(0), clock_, kOwnEpoch) {
    joined_.run();
  }

  void send(double time, std::uint32_t sender, aoim::GroupIndex group,
            std::span<const std::byte> datagram) {
    go_to(time);
    const auto to = group == aoim::kBaseGroup ? pool_.base() : pool_.address(group.value - 1U);
    static_cast<void>(network_.link(1 + sender / kPeersOfAddress).send(to, datagram));
  }

  /// Takes all that was sent by `time`.
  void step(double time) {
    go_to(time);
    peer::Peer& peer = joined_.peer();
    const MeasuredStep before = sums_;
    const double begun = thread_cpu();
    while (peer.read_step(clock_.now()) > 0 || peer.has_inbound())
      peer.model_step(clock_.now(), clock_.utc_now());
    peer.model_step(clock_.now(), clock_.utc_now());
    peer.write_step();
    const double cpu = thread_cpu() - begun;
    sums_ = sums(time);
    steps_.push_back({sums_.datagrams - before.datagrams, sums_.updates - before.updates,
                      sums_.known, time - before.seconds, cpu});
  }
  [[nodiscard]] const std::vector<MeasuredStep>& steps() const noexcept { return steps_; }
  /// With headers of UDP and IPv4, so far.
  [[nodiscard]] std::uint64_t octets() {
    return counted("octets_in") + peer::kUdpIpv4Headers * counted("datagrams_in");
  }
  /// Joined now, without the base group.
  [[nodiscard]] std::size_t groups() {
    const peer::LinkStatistics link = joined_.peer().link().statistics();
    return link.joins - link.leaves - 1;
  }

 private:
  static peer::SimulatedNetworkOptions options_of(const ScaleSetting& setting) {
    peer::SimulatedNetworkOptions options;
    options.links = 2 + (setting.peers - 1) / kPeersOfAddress;
    options.datagrams_in_flight = kInFlight;
    options.seed = setting.seed;
    return options;
  }
  static peer::FederateOptions federate(const peer::SceneFile& scene) {
    peer::FederateOptions options;
    options.name = "measured";
    options.scene = scene;
    options.loops = peer::FederateLoops::by_hand;
    options.site = kOwnSite;
    return options;
  }
  /// Of the whole life, as if it were one step.
  [[nodiscard]] MeasuredStep sums(double time) {
    MeasuredStep sums;
    sums.datagrams = counted("datagrams_in");
    for (const std::string_view counter :
         {"updates_in", "not_interesting", "repeats_in", "stale_in"})
      sums.updates += counted(counter);
    joined_.peer().views().update();
    sums.known = joined_.peer().views().read().entities;
    sums.seconds = time;
    return sums;
  }
  void go_to(double time) { clock_.set(std::max(clock_.now(), kBegin + pdu::from_seconds(time))); }
  [[nodiscard]] std::uint64_t counted(std::string_view name) {
    const peer::Counter* counter = joined_.peer().counters().find(name);
    return counter != nullptr ? counter->value() : 0;
  }

  peer::GroupPool pool_;
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  peer::JoinedPeer joined_;
  MeasuredStep sums_;
  std::vector<MeasuredStep> steps_;
};

/// What the light peers said, tick by tick.
class Recording {
 public:
  void add(double time, std::uint32_t sender, aoim::GroupIndex group,
           std::span<const std::byte> datagram) {
    sent_.push_back({time, sender, group, octets_.size(), datagram.size()});
    octets_.insert(octets_.end(), datagram.begin(), datagram.end());
  }
  void end_tick(double share) { ticks_.push_back({share, sent_.size()}); }

  /// @param step is told the share of the run; false ends it
  void replay(Bystander& to, const ScaleProgress& step) const {
    std::size_t next = 0;
    for (const Tick& tick : ticks_) {
      for (; next < tick.sent; ++next) {
        const Sent& sent = sent_[next];
        to.send(sent.time, sent.sender, sent.group,
                std::span(octets_).subspan(sent.offset, sent.length));
      }
      if (!step(tick.share)) break;
    }
  }

 private:
  struct Sent {
    double time;
    std::uint32_t sender;
    aoim::GroupIndex group;
    std::size_t offset, length;
  };
  struct Tick {
    double share;
    std::size_t sent;  // of all, by its end
  };
  std::vector<Sent> sent_;
  std::vector<std::byte> octets_;
  std::vector<Tick> ticks_;
};

/// What a whole peer takes that hears the recording.
MeasuredPeer listen(const ScaleSetting& setting, const peer::SceneFile& scene,
                    const Recording& recording, const ScaleProgress& progress) {
  const auto bystander = std::make_unique<Bystander>(setting, scene);
  MeasuredPeer run;
  std::size_t warm = 0;
  const double end = kWarmUp + setting.seconds;
  recording.replay(*bystander, [&](double share) {
    const double time = share * end;
    bystander->step(time);
    if (warm == 0 && time >= kWarmUp) {
      warm = bystander->steps().size();
      run.octets = bystander->octets();
    }
    return progress(share);
  });

  run.peers = setting.peers;
  run.entities = setting.crowd.entities;
  run.octets = bystander->octets() - run.octets;
  run.groups = bystander->groups();
  run.steps.assign(bystander->steps().begin() + static_cast<std::ptrdiff_t>(warm),
                   bystander->steps().end());
  return run;
}

/// The sums of its steps.
void sum_up(MeasuredPeer& run) {
  for (const MeasuredStep& step : run.steps) {
    run.datagrams += step.datagrams;
    run.updates += step.updates;
    run.seconds += step.seconds;
    run.cpu += step.cpu;
    run.known = step.known;
  }
}

}  // namespace

MeasuredPeer run_measured_peer(const ScaleSetting& setting, const ScaleDesign& design,
                               const ScaleProgress& progress) {
  if (setting.peers > kMostLightPeers)
    throw tools::UsageError(
        fmt::format("--measure: links to more than {} peers take too much memory; take "
                    "--peers {} or fewer, each with more entities",
                    kMostLightPeers, kMostLightPeers));
  const peer::SceneFile scene = scale_scene(setting, design);
  ScaleSetting light = setting;
  light.scene_hash = scene.hash;
  light.witnesses = 0;
  // The light ones first, the whole one afterwards: their tables would take its caches from it, the
  // more of them there are, as no other host's do.
  Recording recording;
  static_cast<void>(run_world(
      light, design,
      [&](double share) {
        recording.end_tick(share);
        return !progress || progress(0.9 * share);
      },
      [&](auto... sent) { recording.add(sent...); }));

  // The same each time but for the CPU: other programs take caches and time from some steps of each
  // turn, from none of them in all turns.
  MeasuredPeer least;
  for (int turn = 0; turn < kTurns; ++turn) {
    MeasuredPeer run = listen(setting, scene, recording, [&](double share) {
      return !progress || progress(0.9 + 0.1 * (turn + share) / kTurns);
    });
    for (std::size_t i = 0; i < std::min(run.steps.size(), least.steps.size()); ++i)
      run.steps[i].cpu = std::min(run.steps[i].cpu, least.steps[i].cpu);
    least = std::move(run);
  }
  sum_up(least);
  return least;
}

namespace {

constexpr int kTerms = 4;

/// Of each step, in shares of the mean step of its run.
struct ShareTable {
  Eigen::MatrixXd terms;  ///< datagrams, updates, known x seconds, seconds
  Eigen::VectorXd cpu;
  std::vector<Eigen::Index> begins;  ///< of each run's rows; behind the last the end
};

ShareTable shares_of(std::span<const MeasuredPeer> runs) {
  ShareTable table;
  table.begins = {0};
  for (const MeasuredPeer& run : runs)
    table.begins.push_back(table.begins.back() +
                           static_cast<Eigen::Index>(std::max<std::size_t>(1, run.steps.size())));
  table.terms.resize(table.begins.back(), kTerms);
  table.cpu.resize(table.begins.back());
  Eigen::Index row = 0;
  const auto add = [&](const auto& of, double mean) {
    table.terms.row(row) << static_cast<double>(of.datagrams), static_cast<double>(of.updates),
        static_cast<double>(of.known) * of.seconds, of.seconds;
    table.terms.row(row) /= mean;
    table.cpu[row++] = of.cpu / mean;
  };
  for (const MeasuredPeer& run : runs) {
    if (run.steps.empty()) add(run, run.cpu);
    for (const MeasuredStep& step : run.steps)
      add(step, run.cpu / static_cast<double>(run.steps.size()));
  }
  return table;
}

Eigen::VectorXd fitted(const Eigen::MatrixXd& terms, const Eigen::VectorXd& cpu) {
  return terms.completeOrthogonalDecomposition().solve(cpu);
}

/// RMS of what each run's rows are off what all other runs predict; of one run alone, what its rows
/// are off their fit.
double miss_of_others(const ShareTable& table) {
  const Eigen::Index rows = table.cpu.size();
  const std::size_t runs = table.begins.size() - 1;
  double sum = 0;
  for (std::size_t run = 0; run < runs; ++run) {
    const Eigen::Index begin = table.begins[run], count = table.begins[run + 1] - begin;
    const Eigen::Index behind = rows - begin - count;
    Eigen::MatrixXd others(rows - count, kTerms);
    Eigen::VectorXd cpu(rows - count);
    others << table.terms.topRows(begin), table.terms.bottomRows(behind);
    cpu << table.cpu.head(begin), table.cpu.tail(behind);
    const Eigen::VectorXd costs = runs > 1 ? fitted(others, cpu) : fitted(table.terms, table.cpu);
    sum += (table.terms.middleRows(begin, count) * costs - table.cpu.segment(begin, count))
               .squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(rows));
}

}  // namespace

PeerCosts fit_costs(std::span<const MeasuredPeer> runs) {
  constexpr double kEqual = 1e-9;
  const ShareTable table = shares_of(runs);

  // Of all choices of terms whose costs are none below 0 the one that predicts each run best from
  // the others: as many terms as runs would fit whatever was measured. Of equally good ones the
  // shortest.
  PeerCosts best;
  double best_miss = std::numeric_limits<double>::infinity();
  std::vector<unsigned> choices((1U << kTerms) - 1);
  std::iota(choices.begin(), choices.end(), 1U);
  std::ranges::stable_sort(choices, {}, [](unsigned terms) { return std::popcount(terms); });
  for (const unsigned terms : choices) {
    ShareTable chosen = table;
    for (int term = 0; term < kTerms; ++term)
      if ((terms >> term & 1U) == 0) chosen.terms.col(term).setZero();
    const Eigen::VectorXd costs = fitted(chosen.terms, chosen.cpu);
    if (costs.minCoeff() < 0) continue;
    const double miss = miss_of_others(chosen);
    if (miss + kEqual >= best_miss) continue;
    best_miss = miss;
    best = {costs[0], costs[1], costs[2], costs[3], 0};
  }
  double sum = 0;
  for (const MeasuredPeer& run : runs) sum += std::pow(best.of(run) / run.cpu - 1, 2);
  best.spread = std::sqrt(sum / static_cast<double>(runs.size()));
  return best;
}

double log_slope(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 2) return 0;
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  const double spread = n * sxx - sx * sx;
  return spread > 1e-12 * n * sxx ? (n * sxy - sx * sy) / spread : 0;
}

}  // namespace reckon::bench
