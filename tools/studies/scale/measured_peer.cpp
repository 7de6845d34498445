// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/studies/scale/measured_peer.hpp"

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

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/studies/scale/thread_cpu.hpp"
#include "reckon/tools/studies/scale/whole_peer.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kBegin = std::chrono::seconds(1);
constexpr std::size_t kPeersOfAddress = 60;  // a peer keeps 64 of one address and port in mind
constexpr std::size_t kInFlight = 16'384;    // datagrams towards it within a tick
constexpr int kTurns = 15;                   // of which, step by step, the least counts
constexpr std::uint64_t kHeaders = 28;       // of UDP and IPv4 [octets]
constexpr std::uint16_t kOwnSite = 2;        // the light peers have 1
constexpr std::uint32_t kOwnEpoch = 0x7fff0001;

/// The peer and the network around it.
class Bystander {
 public:
  Bystander(const ScaleSetting& setting, const peer::SceneFile& scene)
      : pool_(scene.network.group, scene.aoim.pool),
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
    const double begun = thread_cpu();
    while (peer.read_step(clock_.now()) > 0 || peer.has_inbound())
      peer.model_step(clock_.now(), clock_.utc_now());
    peer.model_step(clock_.now(), clock_.utc_now());
    peer.write_step();
    steps_.push_back(thread_cpu() - begun);
  }
  /// CPU of each step so far [s].
  [[nodiscard]] const std::vector<double>& steps() const noexcept { return steps_; }

  /// Sums since the begin.
  [[nodiscard]] MeasuredPeer sums() {
    peer::Peer& peer = joined_.peer();
    MeasuredPeer sums;
    sums.datagrams = counted("datagrams_in");
    sums.octets = counted("octets_in") + kHeaders * sums.datagrams;
    for (const std::string_view counter :
         {"updates_in", "not_interesting", "repeats_in", "stale_in"})
      sums.updates += counted(counter);
    peer.views().update();
    sums.known = peer.views().read().entities;
    const peer::LinkStatistics link = peer.link().statistics();
    sums.groups = link.joins - link.leaves - 1;  // without the base group
    return sums;
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
  void go_to(double time) { clock_.set(std::max(clock_.now(), kBegin + pdu::from_seconds(time))); }
  [[nodiscard]] std::uint64_t counted(std::string_view name) {
    const peer::Counter* counter = joined_.peer().counters().find(name);
    return counter != nullptr ? counter->value() : 0;
  }

  peer::GroupPool pool_;
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  peer::JoinedPeer joined_;
  std::vector<double> steps_;
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
struct Turn {
  MeasuredPeer run;
  std::vector<double> steps;  ///< CPU of those that count [s]
};

Turn listen(const ScaleSetting& setting, const peer::SceneFile& scene, const Recording& recording,
            const ScaleProgress& progress) {
  const auto bystander = std::make_unique<Bystander>(setting, scene);
  MeasuredPeer before;
  std::size_t warm = 0;
  double begun = -1, time = 0;
  const double end = kWarmUp + setting.seconds;
  recording.replay(*bystander, [&](double share) {
    time = share * end;
    bystander->step(time);
    if (begun < 0 && time >= kWarmUp) {
      before = bystander->sums();
      warm = bystander->steps().size();
      begun = time;
    }
    return progress(share);
  });

  Turn turn{bystander->sums(), {}};
  turn.steps.assign(bystander->steps().begin() + static_cast<std::ptrdiff_t>(warm),
                    bystander->steps().end());
  MeasuredPeer& run = turn.run;
  run.peers = setting.peers;
  run.entities = setting.crowd.entities;
  run.seconds = time - begun;
  run.datagrams -= before.datagrams;
  run.octets -= before.octets;
  run.updates -= before.updates;
  return turn;
}

}  // namespace

MeasuredPeer run_measured_peer(const ScaleSetting& setting, const ScaleDesign& design,
                               const ScaleProgress& progress) {
  if (setting.peers > kMostLightPeers)
    throw UsageError(
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
  Turn least;
  for (int number = 0; number < kTurns; ++number) {
    Turn turn = listen(setting, scene, recording, [&](double share) {
      return !progress || progress(0.9 + 0.1 * (number + share) / kTurns);
    });
    if (number > 0)
      for (std::size_t i = 0; i < std::min(turn.steps.size(), least.steps.size()); ++i)
        turn.steps[i] = std::min(turn.steps[i], least.steps[i]);
    least = std::move(turn);
  }
  least.run.cpu = std::accumulate(least.steps.begin(), least.steps.end(), 0.0);
  return least.run;
}

double PeerCosts::of(const MeasuredPeer& run) const {
  return datagram * static_cast<double>(run.datagrams) + update * static_cast<double>(run.updates) +
         (idle + entity * static_cast<double>(run.known)) * run.seconds;
}

namespace {

/// RMS of the share by which each run is off what all others predict. @param shares of the terms,
/// a row a run
double miss_of_others(const Eigen::MatrixXd& shares) {
  const Eigen::Index rows = shares.rows();
  double sum = 0;
  for (Eigen::Index left_out = 0; left_out < rows; ++left_out) {
    Eigen::MatrixXd others(rows - 1, shares.cols());
    others << shares.topRows(left_out), shares.bottomRows(rows - 1 - left_out);
    const Eigen::VectorXd costs =
        others.completeOrthogonalDecomposition().solve(Eigen::VectorXd::Ones(rows - 1));
    const double off = shares.row(left_out).dot(costs) - 1;
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(rows));
}

}  // namespace

PeerCosts fit_costs(std::span<const MeasuredPeer> runs) {
  constexpr int kTerms = 4;
  constexpr double kEqual = 1e-9;
  const auto rows = static_cast<Eigen::Index>(runs.size());
  Eigen::MatrixXd shares(rows, kTerms);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const MeasuredPeer& run = runs[static_cast<std::size_t>(i)];
    shares.row(i) << static_cast<double>(run.datagrams), static_cast<double>(run.updates),
        static_cast<double>(run.known) * run.seconds, run.seconds;
    shares.row(i) /= run.cpu;
  }
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rows);

  // Of all choices of terms whose costs are none below 0 the one that predicts each run best from
  // the others: as many terms as runs would fit whatever was measured. Of equally good ones the
  // shortest.
  PeerCosts best;
  double best_miss = std::numeric_limits<double>::infinity();
  std::vector<unsigned> choices((1U << kTerms) - 1);
  std::iota(choices.begin(), choices.end(), 1U);
  std::ranges::stable_sort(choices, {}, [](unsigned terms) { return std::popcount(terms); });
  for (const unsigned terms : choices) {
    Eigen::MatrixXd chosen = shares;
    for (int term = 0; term < kTerms; ++term)
      if ((terms >> term & 1U) == 0) chosen.col(term).setZero();
    const Eigen::VectorXd costs = chosen.completeOrthogonalDecomposition().solve(ones);
    const double miss = rows > 1 ? miss_of_others(chosen) : (chosen * costs - ones).norm();
    if (costs.minCoeff() < 0 || miss + kEqual >= best_miss) continue;
    best_miss = miss;
    const double spread = (chosen * costs - ones).norm() / std::sqrt(static_cast<double>(rows));
    best = {costs[0], costs[1], costs[2], costs[3], spread};
  }
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
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace reckon::tools
