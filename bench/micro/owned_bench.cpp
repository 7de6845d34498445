// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of owned entities for a peer: the same row has the time of a check, the share of a core at
// 60 Hz, the updates sent at thresholds of 1 m and 3 degrees, the error of a receiver, and the
// memory of each entity.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <vector>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/micro/resident.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/support/town_traffic.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kFrame{16'666'667};  // 60 Hz

// Circles of 50 to 150 m at 10 m/s, each with another start.
EntityTruth drive(std::uint32_t index, nanoseconds now) {
  const double radius = 50.0 + index % 100;
  const double rate = 10.0 / radius;
  const double angle = rate * pdu::to_seconds(now) + index;
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
  const Eigen::Vector3d along(-std::sin(angle), std::cos(angle), 0.0);
  EntityTruth truth;
  truth.time = now;
  truth.position =
      radius * out + Eigen::Vector3d(200.0 * (index % 100), 200.0 * (index / 100), 0.0);
  truth.orientation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * truth.orientation;
  truth.velocity = 10.0 * along;
  truth.acceleration = -10.0 * rate * out;
  truth.angular_velocity = {0, 0, -rate};
  return truth;
}

// One peer without devices in a world of 20 km; its datagrams arrive at link 1.
class Owner {
 public:
  explicit Owner(std::uint32_t count)
      : scene_(*dis_exercise(1)),
        clock_(std::chrono::seconds(1), std::chrono::hours(1)),
        network_(two_links(), clock_),
        peer_(scene_, {}, network_.link(0), {}) {
    peer_.start(clock_.now());
    EntityDescription truck;
    truck.type.kind = pdu::EntityKind::platform;
    truck.type.domain = pdu::EntityDomain::land;
    for (std::uint32_t i = 1; i <= count; ++i) {
      EntityTruth truth = drive(i, clock_.now());
      truth.velocity.setZero();
      truth.acceleration.setZero();
      truth.angular_velocity.setZero();
      peer_.model().add(static_cast<EntityNumber>(i), truck, truth);
    }
  }
  void pass(nanoseconds by) {
    advance(by);
    step();
  }
  void advance(nanoseconds by) { clock_.advance(by); }
  void step() {
    peer_.model_step(clock_.now(), clock_.utc_now());
    peer_.write_step();
  }
  [[nodiscard]] Peer& peer() { return peer_; }
  [[nodiscard]] const SceneFile& scene() const { return scene_; }
  [[nodiscard]] Link& link(std::size_t index) { return network_.link(index); }
  [[nodiscard]] nanoseconds now() const { return clock_.now(); }
  [[nodiscard]] nanoseconds utc() const { return clock_.utc_now(); }
  [[nodiscard]] std::uint64_t count(std::string_view name) const {
    return peer_.counters().find(name)->value();
  }

 private:
  static SimulatedNetworkOptions two_links() {
    SimulatedNetworkOptions options;
    options.datagrams_in_flight = 8192;  // all entities in one frame
    return options;
  }
  SceneFile scene_;
  ManualClock clock_;
  SimulatedNetwork network_;
  Peer peer_;
};

// Moving entities, each updated and checked 60 times a second, at thresholds of 1 m and 3 degrees.
void owned_moving(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  Owner owner(count);
  for (int i = 0; i < 120; ++i) owner.pass(kFrame);
  std::vector<EntityTruth> truths(count);
  const auto sent = owner.count("updates_out");
  const nanoseconds begun = owner.now();
  for (auto _ : state) {
    state.PauseTiming();
    for (std::uint32_t i = 0; i < count; ++i) truths[i] = drive(i + 1, owner.now() + kFrame);
    state.ResumeTiming();
    for (std::uint32_t i = 0; i < count; ++i) {
      truths[i].time = owner.now();
      owner.peer().model().move(static_cast<EntityNumber>(i + 1), truths[i]);
    }
    owner.pass(kFrame);
  }
  const double seconds = pdu::to_seconds(owner.now() - begun);
  const auto checks = static_cast<double>(state.iterations()) * count;
  state.counters["per_check"] =
      benchmark::Counter(checks, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["core_at_60_Hz"] =
      benchmark::Counter(pdu::to_seconds(kFrame) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["updates_per_s_each"] =
      static_cast<double>(owner.count("updates_out") - sent) / seconds / count;
  state.counters["octets_each"] = sizeof(OwnedEntity);
}
BENCHMARK(owned_moving)->Arg(100)->Arg(10'000)->Unit(benchmark::kMicrosecond);

// Growth of the process for entities at rest, each with a state that was sent.
void owned_room(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  double none = 0, all = 0;
  for (auto _ : state) {
    {
      Owner owner(0);
      for (int i = 0; i < 10; ++i) owner.pass(milliseconds(2));
      none = bench::resident();
    }
    Owner owner(count);
    for (int i = 0; i < 10; ++i) owner.pass(milliseconds(2));
    all = bench::resident();
  }
  state.counters["octets_each"] = (all - none) / count;
  state.counters["octets_of_the_struct"] = sizeof(OwnedEntity);
}
BENCHMARK(owned_room)->Arg(65'000)->Iterations(1);

// A peer that receives the owner's updates and computes its own error.
class Listener {
 public:
  explicit Listener(Owner& owner)
      : owner_(owner), peer_(owner.scene(), other(), owner.link(1), {}) {
    peer_.start(owner.now());
  }
  void pass() {
    peer_.read_step(owner_.now());
    peer_.model_step(owner_.now(), owner_.utc());
    peer_.write_step();
  }
  // Greatest distance and sum of squared distances [m^2] between shown and true positions.
  void compare(std::span<const EntityTruth> truths, double& most, double& squares) const {
    for (const RemoteEntity& row : peer_.model().remote().rows()) {
      const double off =
          (row.shown(owner_.now()).position - truths[row.id.entity - 1u].position).norm();
      most = std::max(most, off);
      squares += off * off;
    }
  }
  [[nodiscard]] std::size_t size() const { return peer_.model().remote().rows().size(); }

 private:
  static PeerOptions other() {
    PeerOptions options;
    options.application = 2;
    options.epoch = 2;
    return options;
  }
  Owner& owner_;
  Peer peer_;
};

// The recorded vehicles of a town, repeated with offsets, each updated and checked 60 times a
// second: time of the peer alone, for each frame.
void owned_traffic(benchmark::State& state) {
  const char* folder = std::getenv("RECKON_DATA");
  const std::filesystem::path file =
      std::filesystem::path(folder != nullptr ? folder : RECKON_SOURCE_DIR "/../shared/data") /
      test::kTownTraffic;
  if (!std::filesystem::exists(file)) return state.SkipWithError("needs RECKON_DATA");
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<EntityTrack> tracks = test::town_traffic(file, count);
  std::vector<EntityTruth> truths(count);
  Owner owner(static_cast<std::uint32_t>(count));
  Listener listener(owner);
  double most = 0, squares = 0, shown = 0;
  const nanoseconds begun = owner.now();
  bench::Blocks frames;
  int frame = 0;
  std::uint64_t sent = 0;
  constexpr int kSettled = 120;  // frames
  for (auto _ : state) {
    const double time = pdu::to_seconds(owner.now() + kFrame - begun);
    for (std::size_t i = 0; i < count; ++i)
      truths[i] = truth_of(tracks[i].at(time), owner.now() + kFrame);
    const double spent = 1e-9 * bench::cpu_ns_of([&] {
                           owner.advance(kFrame);
                           for (std::size_t i = 0; i < count; ++i)
                             owner.peer().model().move(static_cast<EntityNumber>(i + 1), truths[i]);
                           owner.step();
                         });
    state.SetIterationTime(spent);
    listener.pass();
    if (++frame == kSettled) sent = owner.count("updates_out");
    if (frame <= kSettled) continue;
    frames.add(spent / pdu::to_seconds(kFrame));
    listener.compare(truths, most, squares);
    shown += static_cast<double>(count);
  }
  if (frame <= kSettled) return;
  frames.report(state, "core_at_60_Hz");
  state.counters["seen"] = static_cast<double>(listener.size());
  state.counters["error_rms_m"] = std::sqrt(squares / shown);
  state.counters["error_max_m"] = most;
  state.counters["updates_per_s_each"] = static_cast<double>(owner.count("updates_out") - sent) /
                                         ((frame - kSettled) * pdu::to_seconds(kFrame)) /
                                         static_cast<double>(count);
}
BENCHMARK(owned_traffic)->Arg(10'000)->Unit(benchmark::kMillisecond)->UseManualTime();

// Entities at rest, including heartbeats: passes of 2 ms.
void owned_resting(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  Owner owner(count);
  for (int i = 0; i < 60'000; ++i) owner.pass(milliseconds(2));
  const auto sent = owner.count("updates_out");
  const nanoseconds begun = owner.now();
  for (auto _ : state) owner.pass(milliseconds(2));
  const double seconds = pdu::to_seconds(owner.now() - begun);
  state.counters["core"] =
      benchmark::Counter(seconds, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["updates_per_s"] =
      static_cast<double>(owner.count("updates_out") - sent) / seconds;
}
BENCHMARK(owned_resting)->Arg(0)->Arg(10'000)->Arg(65'000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace reckon::peer
