// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What owning entities costs a peer: the same row tells the time of a check, the share of a core at
// 60 Hz, what was sent at thresholds of 1 m and 3 degrees, and the memory of each.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/network/simulated_network.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kFrame{16'666'667};  // 60 Hz

// Circles of 50 to 150 m at 10 m/s, each begun elsewhere.
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

// One peer without devices in a world of 20 km, whose datagrams nobody hears.
class Owner {
 public:
  explicit Owner(std::uint32_t count)
      : scene_(dis_exercise(1)),
        clock_(std::chrono::seconds(1), std::chrono::hours(1)),
        network_({}, clock_),
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
    clock_.advance(by);
    peer_.model_step(clock_.now(), clock_.utc_now());
    peer_.write_step();
  }
  [[nodiscard]] Peer& peer() { return peer_; }
  [[nodiscard]] nanoseconds now() const { return clock_.now(); }
  [[nodiscard]] std::uint64_t count(std::string_view name) const {
    return peer_.counters().find(name)->value();
  }

 private:
  SceneFile scene_;
  ManualClock clock_;
  SimulatedNetwork network_;
  Peer peer_;
};

// Ten thousand that drive, each told and checked 60 times a second, at thresholds of 1 m and 3
// degrees.
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

// Entities that rest, heartbeats included: passes of 2 ms.
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
