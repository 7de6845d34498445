// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A table of many entities, of which a tenth moves and another tenth can be felt: cost of an update
// from its octets on, cost of a pass without updates, and memory of each entity.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/micro/resident.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kMidnight = std::chrono::hours(500'000);  // UTC
constexpr std::size_t kStates = 9, kBlock = 64;  // states in a datagram; datagrams in a block
constexpr std::size_t kStateSize = pdu::kFixedSize<pdu::EntityState>;
constexpr double kSpacing = 20;  // [m]
constexpr const char* kScene =
    "[network]\ntouch = \"all\"\n[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n";

class FullTable {
 public:
  explicit FullTable(std::uint32_t entities)
      : entities_(entities),
        side_(static_cast<std::uint32_t>(std::ceil(std::sqrt(entities)))),
        scene_(parse_scene_file(kScene, "bench")),
        frame_(0.8, 0.1, 400),
        pool_(scene_.network.group, scene_.aoim.pool),
        aoim_(aoim_config(scene_), presence(scene_, frame_, pool_, {{1, 1}, "me", 5, 0, false})),
        before_(bench::resident()),
        remote_(frame_, aoim_, settings(), counters_),
        block_(kBlock, std::vector<std::byte>(kStates * kStateSize)) {
    const std::array<aoim::Focus, 1> here{{{{0, 0, 0}, 0.0, scene_.aoim.radius}}};
    static_cast<void>(aoim_.listen(aoim::kCellTier, here, nanoseconds(0)));
    fill();
  }

  /// Memory of each entity [octets].
  [[nodiscard]] double memory() const { return memory_; }

  /// CPU time of an update from its octets on [ns], over a block of updates for moving entities.
  double take_block() {
    now_ += milliseconds(2);
    for (std::vector<std::byte>& datagram : block_) write(datagram);
    std::size_t taken = 0;
    const double spent = bench::cpu_ns_of([&] {
      for (const std::vector<std::byte>& datagram : block_) {
        const std::span<const Inbound> updates = decoder_.decode(datagram, {1, 1});
        remote_.prefetch(updates);
        for (const Inbound& update : updates)
          taken += remote_.take(update, arrival(), servo_) ? 1 : 0;
      }
    });
    if (taken != kBlock * kStates) throw std::runtime_error("an update was refused");
    return spent / (kBlock * kStates);
  }

  /// CPU time of a pass without updates, with a hand [ns].
  double idle_pass() {
    constexpr int kPasses = 10;
    return bench::cpu_ns_of([this] {
             for (int i = 0; i < kPasses; ++i) {
               now_ += milliseconds(2);
               hand_[0].position.z() += ++pass_ % 100 < 50 ? 0.002 : -0.002;
               remote_.expire(now_);
               remote_.find_near(hand_, now_, near_, {}, hands_near_);
             }
           }) /
           kPasses;
  }

 private:
  [[nodiscard]] Arrival arrival() const { return {now_, kMidnight + now_, now_, 0, {}, {}}; }

  [[nodiscard]] RemoteSettings settings() const {
    RemoteSettings settings = remote_settings(scene_);
    settings.capacity = entities_;
    settings.strangers_memory = std::numeric_limits<std::size_t>::max();
    return settings;
  }

  // Every tenth entity can be felt, another tenth moves.
  void fill() {
    Inbound update;
    update.has_state = true;
    update.model.kind = pdu::ForceModelKind::sphere;
    update.model.k1 = 200;
    update.model.radius = 0.5F;
    update.model.validity_ms = 60'000;  // longest silence
    for (std::uint32_t i = 0; i < entities_; ++i) {
      update.state = state_of(i);
      update.entity = update.state.entity_id;
      update.has_model = i % 10 == 1;
      if (!remote_.take(update, arrival(), servo_)) throw std::runtime_error("no room");
    }
    const auto felt = std::ranges::count_if(remote_.rows(), &RemoteEntity::haptic);
    if (felt != entities_ / 10) throw std::runtime_error("not every tenth entity can be felt");
    memory_ = (bench::resident() - before_) / entities_;
    // The first passes check all entities at once, the later ones in turn.
    for (int i = 0; i < 400; ++i) static_cast<void>(idle_pass());
  }

  [[nodiscard]] pdu::EntityState state_of(std::uint32_t i) const {
    deadreckon::KinematicState motion;
    motion.position = {kSpacing * (1 + i % side_), kSpacing * (1 + i / side_), 0};
    if (i % 10 == 0) {
      motion.algorithm = pdu::DeadReckoningAlgorithm::fpw;
      motion.velocity = {10, 0, 0};
    }
    pdu::EntityState state;
    state.header.exercise_id = scene_.network.exercise;
    state.header.timestamp = pdu::to_dis_timestamp(kMidnight + now_, true);
    state.entity_id = {7, static_cast<std::uint16_t>(1 + (i >> 12)),
                       static_cast<std::uint16_t>((i & 0xFFF) + 1)};
    state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
    static_cast<void>(to_wire(motion, frame_, state));
    return state;
  }

  // Writes the next entities, in an order without neighbours.
  void write(std::vector<std::byte>& datagram) {
    const std::uint32_t moving = entities_ / 10;
    for (std::size_t i = 0; i < kStates; ++i) {
      if (turn_ == moving) turn_ = 0;
      const auto which = static_cast<std::uint32_t>(std::uint64_t{turn_++} * 7919 % moving);
      (void)pdu::encode(state_of(10 * which),
                        std::span(datagram).subspan(i * kStateSize, kStateSize));
    }
  }

  std::uint32_t entities_, side_;
  SceneFile scene_;
  deadreckon::LocalFrame frame_;
  GroupPool pool_;
  Counters counters_;
  aoim::AreaOfInterestManager aoim_;
  double before_, memory_ = 0;
  RemoteEntities remote_;
  const haptics::ServoSnapshot servo_;  // of no hand
  DatagramDecoder decoder_{1, counters_};
  std::vector<std::vector<std::byte>> block_;
  std::array<deadreckon::ProbeState, 1> hand_;
  std::array<NearBodies, 1> near_;
  HandsNear hands_near_;
  std::uint32_t turn_ = 0;
  std::size_t pass_ = 0;
  nanoseconds now_ = seconds(1);
};

void full_table(benchmark::State& state) {
  try {
    FullTable table(static_cast<std::uint32_t>(state.range(0)));
    for (int i = 0; i < 200; ++i) static_cast<void>(table.take_block());
    bench::Blocks update, idle;
    for (auto _ : state) {
      update.add(table.take_block());
      idle.add(table.idle_pass());
    }
    update.report(state, "update_ns");
    idle.report(state, "idle_pass_ns");
    state.counters["octets_each"] = table.memory();
  } catch (const std::exception& failure) {
    state.SkipWithError(failure.what());
  }
}
BENCHMARK(full_table)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Iterations(400);

}  // namespace
}  // namespace reckon::peer
