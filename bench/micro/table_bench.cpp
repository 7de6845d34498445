// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of the table of remote entities: an update, a pass over it, a picture, its memory.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/micro/resident.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kUtc = std::chrono::hours(500'000);

// The receiving half of a peer in a world of 100 km, and the updates that it receives: each entity
// drives at 10 m/s from its own place of a square grid.
class World {
 public:
  World(std::uint32_t entities, pdu::DeadReckoningAlgorithm algorithm, double spacing,
        const char* sections = "")
      : scene_(parse_scene_file(
            std::string(
                "[network]\ntouch = \"all\"\n[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n") +
                sections,
            "bench")),
        frame_(0.8, 0.1, 400),
        pool_(scene_.network.group, scene_.aoim.pool),
        aoim_(aoim_config(scene_), presence(scene_, frame_, pool_, {{1, 1}, "me", 5, 0, false})),
        remote_(frame_, aoim_, settings(), counters_),
        updates_(entities) {
    const std::array<aoim::Focus, 1> here{{{{0, 0, 0}, 0.0, scene_.aoim.radius}}};
    static_cast<void>(aoim_.listen(aoim::kCellTier, here, nanoseconds(0)));
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(entities)));
    for (std::uint32_t i = 0; i < entities; ++i) {
      deadreckon::KinematicState state;
      state.algorithm = algorithm;
      state.position = {spacing * (1 + i % side), spacing * (1 + i / side), 0};
      state.velocity = {10, 0, 0};
      state.angular_velocity = {0, 0, 0.1};
      Inbound& update = updates_[i];
      update.entity = update.state.entity_id = {7, static_cast<std::uint16_t>(1 + (i >> 12)),
                                                static_cast<std::uint16_t>((i & 0xFFF) + 1)};
      update.has_state = true;
      update.state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
      static_cast<void>(to_wire(state, frame_, update.state));
    }
  }

  // The next entity's update arrives; after each round the updates are 200 ms later.
  void hear_next() {
    if (next_ == updates_.size()) next_ = 0, now_ += milliseconds(200);
    Inbound& update = updates_[next_++];
    update.state.header.timestamp = pdu::to_dis_timestamp(kUtc + now_, true);
    remote_.take(update, {now_, kUtc + now_, now_, 0, {}}, servo_);
  }
  // The next eight updates, of one datagram.
  void hear_bundle() {
    const std::size_t first = next_ < updates_.size() ? next_ : 0;
    remote_.prefetch(
        std::span(updates_).subspan(first, std::min<std::size_t>(8, updates_.size() - first)));
    for (int i = 0; i < 8; ++i) hear_next();
  }
  void hear_all() {
    for (std::size_t i = 0; i < updates_.size(); ++i) hear_next();
  }
  // From now on the updates contain a force model.
  void make_touchable() {
    for (Inbound& update : updates_) {
      update.has_model = true;
      update.model.kind = pdu::ForceModelKind::sphere;
      update.model.k1 = 200;
      update.model.radius = 0.5F;
    }
  }

  [[nodiscard]] RemoteEntities& remote() { return remote_; }
  [[nodiscard]] nanoseconds now() const { return now_; }
  [[nodiscard]] const deadreckon::LocalFrame& frame() const { return frame_; }
  [[nodiscard]] aoim::AreaOfInterestManager& aoim() { return aoim_; }
  [[nodiscard]] RemoteSettings settings() const {
    RemoteSettings settings = remote_settings(scene_);
    settings.strangers_memory = std::numeric_limits<std::size_t>::max();
    return settings;
  }

 private:
  SceneFile scene_;
  deadreckon::LocalFrame frame_;
  GroupPool pool_;
  Counters counters_;
  aoim::AreaOfInterestManager aoim_;
  RemoteEntities remote_;
  const haptics::ServoSnapshot servo_;  // of no hand
  std::vector<Inbound> updates_;
  std::size_t next_ = 0;
  nanoseconds now_ = seconds(1);
};

constexpr std::uint32_t kEntities = 10'000;

// An update of a known entity, 10,000 of them in turn at 5 Hz.
void take_update(benchmark::State& state, pdu::DeadReckoningAlgorithm algorithm,
                 const char* sections) {
  World world(kEntities, algorithm, 100, sections);
  world.hear_all();
  if (world.remote().rows().size() != kEntities) return state.SkipWithError("no room");
  for (auto _ : state) world.hear_next();
}
// The same with eight in a datagram; for each update.
void take_bundle(benchmark::State& state, pdu::DeadReckoningAlgorithm algorithm) {
  World world(static_cast<std::uint32_t>(state.range(0)), algorithm, 100);
  world.hear_all();
  for (auto _ : state) world.hear_bundle();
  state.SetItemsProcessed(8 * static_cast<std::int64_t>(state.iterations()));
}
constexpr const char* kAdaptive = "[convergence]\nprediction = \"adaptive\"\n";
using Algorithm = pdu::DeadReckoningAlgorithm;
BENCHMARK_CAPTURE(take_update, static, Algorithm::static_, "");
BENCHMARK_CAPTURE(take_update, fpw, Algorithm::fpw, "");
BENCHMARK_CAPTURE(take_update, rvw, Algorithm::rvw, "");
BENCHMARK_CAPTURE(take_update, fvw, Algorithm::fvw, "");
BENCHMARK_CAPTURE(take_update, rvb, Algorithm::rvb, "");
BENCHMARK_CAPTURE(take_bundle, fpw, Algorithm::fpw)->Arg(1'000)->Arg(10'000)->Arg(100'000);
BENCHMARK_CAPTURE(take_update, fpw_adaptive, Algorithm::fpw, kAdaptive);

// A step in which nothing expires.
void expire_nothing(benchmark::State& state) {
  World world(kEntities, Algorithm::fpw, 100);
  world.hear_all();
  for (auto _ : state) world.remote().expire(world.now());
}
BENCHMARK(expire_nothing);

// Shown poses of all entities at one instant; for each entity in `each_ns`.
void show_all(benchmark::State& state, Algorithm algorithm) {
  World world(kEntities, algorithm, 100);
  world.hear_all();
  world.hear_all();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const nanoseconds now = world.now() + milliseconds(state.range(0));
  for (auto _ : state) {
    for (const RemoteEntity& row : world.remote().rows()) sum += row.shown(now).position;
  }
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(state.iterations() * kEntities);
}
BENCHMARK_CAPTURE(show_all, fpw, Algorithm::fpw)->ArgName("ms_after")->Arg(50)->Arg(1500);
BENCHMARK_CAPTURE(show_all, rvb, Algorithm::rvb)->ArgName("ms_after")->Arg(50)->Arg(1500);

// Search for objects in reach of a hand that moves at 1 m/s, at 500 Hz: by NearSearch, and as a
// plain loop over all rows, in alternation.
void search_near(benchmark::State& state) {
  World world(static_cast<std::uint32_t>(state.range(0)), Algorithm::fpw, 100);
  world.make_touchable();
  world.hear_all();
  nanoseconds now = world.now();
  std::array<deadreckon::ProbeState, 1> hand;
  std::array<NearBodies, 1> found;
  HandsNear hands;
  std::size_t within = 0, plain = 0, step = 0;
  const auto search = [&] {
    now += milliseconds(2);
    hand[0].position.z() += ++step % 100 < 50 ? 0.002 : -0.002;
    world.remote().find_near(hand, now, found, {}, hands);
    within += found[0].bodies().size();
  };
  const auto look_at_all = [&] {
    for (const RemoteEntity& row : world.remote().rows()) {
      if (!row.haptic) continue;
      const deadreckon::Pose pose = row.predicted(now);
      plain += deadreckon::contact(row.model, pose, hand[0].position, 0.01).depth > -0.25;
    }
  };
  search();
  bench::Blocks near, all;
  for (auto _ : state) {
    near.add(bench::nanoseconds_of(search));
    all.add(bench::cpu_ns_of(look_at_all));
  }
  near.report(state, "near_ns");
  all.report(state, "plain_ns");
  if (within + plain != 0) state.SkipWithError("something was near");
  if (!std::ranges::all_of(world.remote().rows(), &RemoteEntity::haptic))
    state.SkipWithError("an entity cannot be felt");
}
BENCHMARK(search_near)->Arg(1'000)->Arg(10'000)->Arg(100'000);

// Check, at 10 Hz, whether entities at rest should still be shown, while our focus rests or drives
// by 0.14 % of its radius each time, to and fro across the middle; and when it jumps away, for each
// entity that is removed.
void look_shown(benchmark::State& state) {
  World world(static_cast<std::uint32_t>(state.range(0)), Algorithm::static_, 100);
  world.hear_all();
  nanoseconds now = world.now();
  double x = 0.0, way = 140.0;
  const auto look = [&](double to) {
    x = to;
    now += milliseconds(100);
    const std::array<aoim::Focus, 1> here{{{{x, 0, 0}, 0.0, 100e3}}};
    static_cast<void>(world.aoim().listen(aoim::kCellTier, here, now));
    return bench::cpu_ns_of([&] { world.remote().look_shown(now); });
  };
  const auto at_rest = look(x);
  benchmark::DoNotOptimize(at_rest);
  bench::Blocks rest, drive;
  double driven = 0.0;
  for (auto _ : state) {
    rest.add(look(x));
    if (std::abs(x + way) > 20e3) way = -way;
    const double taken = look(x + way);
    drive.add(taken);
    driven += taken;
  }
  state.counters["drive_mean_ns"] = driven / static_cast<double>(state.iterations());
  rest.report(state, "rest_ns");
  drive.report(state, "drive_ns");
  const std::size_t shown = world.remote().rows().size();
  double gone = 0.0;
  while (!world.remote().rows().empty()) gone += look(-1e6);
  state.counters["gone_each_ns"] = gone / static_cast<double>(shown);
  state.counters["shown"] = static_cast<double>(shown);
}
BENCHMARK(look_shown)->Arg(1'000)->Arg(10'000)->Arg(100'000)->Iterations(2000);

// The rows of a picture for the terminal.
void choose_view(benchmark::State& state) {
  World world(static_cast<std::uint32_t>(state.range(0)), Algorithm::fpw, 100);
  world.hear_all();
  ViewChoice choice;
  for (auto _ : state) {
    benchmark::DoNotOptimize(choice.choose(world.remote().rows(), Eigen::Vector3d::Zero()).size());
  }
}
BENCHMARK(choose_view)->Arg(64)->Arg(10'000)->Arg(100'000);

// Memory of a table: empty, and for each row in use. Measured by resident memory, so in whole
// pages.
void room(benchmark::State& state, const char* sections) {
  double empty = 0, row = 0;
  for (auto _ : state) {
    World world(kEntities, Algorithm::fpw, 100, sections);
    const double before = bench::resident();
    Counters counters;
    RemoteEntities other(world.frame(), world.aoim(), world.settings(), counters);
    const double made = bench::resident();
    world.hear_all();
    empty = made - before;
    row = (bench::resident() - made) / kEntities;
  }
  state.counters["empty_octets"] = empty;
  state.counters["row_octets"] = row;
  state.counters["entity_octets"] = sizeof(RemoteEntity);
}
BENCHMARK_CAPTURE(room, as_sent, "")->Iterations(1);
BENCHMARK_CAPTURE(room, adaptive, kAdaptive)->Iterations(1);
}  // namespace
}  // namespace reckon::peer
