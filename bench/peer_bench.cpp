// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What clocks, tracks and the table of remote entities cost: the same row tells the time of a call
// and how wrong the answers were.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "reckon/bench/blocks.hpp"
#include "reckon/bench/resident.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/clocks/peer_clock.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"
#include "reckon/peer/clocks/steady_utc.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/tracks/entity_track.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kUtc = std::chrono::hours(500'000);

// Updates at 50 Hz through 20 ms and up to 10 ms more.
struct Update {
  nanoseconds sent, arrival;
  std::uint32_t stamp;
};

std::vector<Update> updates(bool absolute) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(0.0, 10e6);
  std::vector<Update> result;
  for (int i = 0; i < 100'000; ++i) {
    const nanoseconds sent = seconds(100) + milliseconds(20) * i;
    const auto transit = milliseconds(20) + nanoseconds(std::llround(jitter(random)));
    result.push_back({sent, sent + transit, pdu::to_dis_timestamp(kUtc + sent, absolute)});
  }
  return result;
}

void map_timestamps(benchmark::State& state, bool absolute) {
  const std::vector<Update> all = updates(absolute);
  SenderClock clock;
  std::size_t next = 0, counted = 0;
  double squares = 0.0;
  for (auto _ : state) {
    const Update& update = all[next];
    const auto mapped = clock.local_time(update.stamp, update.arrival, kUtc + update.arrival);
    if (!mapped) {
      state.SkipWithError("an update was refused");
      break;
    }
    if (next > 1000) {
      const double error = static_cast<double>((*mapped - update.sent).count());
      squares += error * error;
      ++counted;
    }
    if (++next == all.size()) {
      next = 0;
      clock = {};
    }
  }
  state.counters["rms_ms"] =
      std::sqrt(squares / static_cast<double>(std::max<std::size_t>(counted, 1))) * 1e-6;
}
BENCHMARK_CAPTURE(map_timestamps, absolute, true);
BENCHMARK_CAPTURE(map_timestamps, relative, false);  // errs by the least transit, 20 ms

void hear_a_peer(benchmark::State& state) {
  const auto peers = static_cast<std::uint32_t>(state.range(0));
  PeerClocks clocks;
  pdu::DatagramTrailer trailer;
  for (trailer.epoch = 1; trailer.epoch < peers; ++trailer.epoch) {
    clocks.hear(trailer, kUtc, seconds(1));
  }
  nanoseconds now = seconds(1);
  for (auto _ : state) {
    now += milliseconds(1);
    trailer.send_time = pdu::trailer_time(kUtc + now - milliseconds(1));
    clocks.hear(trailer, kUtc + now, now);
    benchmark::DoNotOptimize(clocks.ahead(trailer.epoch, true, now));
  }
}
BENCHMARK(hear_a_peer)->Arg(1)->Arg(16)->Arg(256);

void keep_utc(benchmark::State& state) {
  SteadyUtc utc;
  nanoseconds now = seconds(1);
  double worst = 0.0;
  for (auto _ : state) {
    now += milliseconds(2);
    const nanoseconds given = utc.at(now, kUtc + now);
    worst = std::max(worst, std::abs(static_cast<double>((given - kUtc - now).count())));
  }
  state.counters["max_ns"] = worst;
}
BENCHMARK(keep_utc);

// --- the table of remote entities

// The incoming half of a peer in a world of 100 km, and what it hears: each entity drives at 10 m/s
// from its own place of a square grid.
class World {
 public:
  World(std::uint32_t entities, pdu::DeadReckoningAlgorithm algorithm, double spacing,
        const char* sections = "")
      : scene_(parse_scene_file(
            std::string("[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n") + sections, "bench")),
        frame_(0.8, 0.1, 400),
        pool_(scene_.network.group, scene_.aoim.pool),
        aoim_(aoim_config(scene_), presence(scene_, frame_, pool_, {{1, 1}, "me", 5, 0, false})),
        remote_(frame_, aoim_, settings(), counters_),
        updates_(entities) {
    const std::array<aoim::Focus, 1> here{{{{0, 0, 0}, 0.0, scene_.aoim.radius}}};
    static_cast<void>(aoim_.set_foci(here, nanoseconds(0)));
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(entities)));
    for (std::uint32_t i = 0; i < entities; ++i) {
      deadreckon::KinematicState state;
      state.algorithm = algorithm;
      state.position = {spacing * (1 + i % side), spacing * (1 + i / side), 0};
      state.velocity = {10, 0, 0};
      state.angular_velocity = {0, 0, 0.1};
      Inbound& update = updates_[i];
      update.entity = update.state.entity_id = {7, static_cast<std::uint16_t>(i >> 12),
                                                static_cast<std::uint16_t>((i & 0xFFF) + 1)};
      update.has_state = true;
      update.state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
      static_cast<void>(to_wire(state, frame_, update.state));
    }
  }

  // The next entity is heard; once around they are 200 ms older.
  void hear_next() {
    if (next_ == updates_.size()) next_ = 0, now_ += milliseconds(200);
    Inbound& update = updates_[next_++];
    update.state.header.timestamp = pdu::to_dis_timestamp(kUtc + now_, true);
    remote_.take(update, {now_, kUtc + now_, now_, 0, {}}, {});
  }
  // The next eight, of one datagram.
  void hear_bundle() {
    const std::size_t first = next_ < updates_.size() ? next_ : 0;
    remote_.prefetch(
        std::span(updates_).subspan(first, std::min<std::size_t>(8, updates_.size() - first)));
    for (int i = 0; i < 8; ++i) hear_next();
  }
  void hear_all() {
    for (std::size_t i = 0; i < updates_.size(); ++i) hear_next();
  }
  // From now on they tell how they feel.
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
  [[nodiscard]] RemoteSettings settings() const { return {0.01, scene_.convergence, {}}; }

 private:
  SceneFile scene_;
  deadreckon::LocalFrame frame_;
  GroupPool pool_;
  Counters counters_;
  aoim::AreaOfInterestManager aoim_;
  RemoteEntities remote_;
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
// The same by eight in a datagram; per update.
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

// What is shown of all at one instant; per entity in `each_ns`.
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

// The search for what a hand could touch that moves at 1 m/s, at 500 Hz: by NearSearch, and as a
// plain loop over all rows, in turns.
void search_near(benchmark::State& state) {
  World world(static_cast<std::uint32_t>(state.range(0)), Algorithm::fpw, 100);
  world.make_touchable();
  world.hear_all();
  nanoseconds now = world.now();
  std::array<deadreckon::ProbeState, 1> hand;
  std::array<NearEntities, 1> found;
  std::size_t within = 0, plain = 0, step = 0;
  const auto search = [&] {
    now += milliseconds(2);
    hand[0].position.z() += ++step % 100 < 50 ? 0.002 : -0.002;
    world.remote().find_near(hand, now, found);
    within += found[0].all().size();
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
    const auto begin = std::chrono::steady_clock::now();
    look_at_all();
    const nanoseconds taken = std::chrono::steady_clock::now() - begin;
    all.add(static_cast<double>(taken.count()));
  }
  near.report(state, "near_ns");
  all.report(state, "plain_ns");
  if (within + plain != 0) state.SkipWithError("something was near");
}
BENCHMARK(search_near)->Arg(1'000)->Arg(10'000)->Arg(100'000);

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

// Memory of a table: empty, and each row in use. Grown resident memory, so pages count whole.
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
// Where so many entities on a track of their own are, one after the other: circles of 20 m, 0.1 s a
// sample. The error is that of the position against the circle.
void follow_tracks(benchmark::State& state, TrackTurn turn) {
  constexpr double kRadius = 20.0, kLap = 4.0 * std::numbers::pi;
  constexpr int kSteps = 126;
  const auto truth = [](double t) {
    return Eigen::Vector3d(kRadius * std::cos(t / 2), kRadius * std::sin(t / 2), 0);
  };
  TrackSamples samples;
  for (int i = 0; i <= kSteps; ++i) {
    samples.times.push_back(kLap * i / kSteps);
    samples.positions.push_back(truth(samples.times.back()));
  }
  std::vector<EntityTrack> tracks;
  for (int i = 0; i < state.range(0); ++i) {
    tracks.emplace_back(std::make_shared<const TrackCurve>(samples, true, turn),
                        Eigen::Vector3d(i, 0, 0));
  }
  double time = 0, worst = 0;
  std::size_t next = 0;
  for (auto _ : state) {
    const deadreckon::KinematicState at = tracks[next].at(time);
    const Eigen::Vector3d miss =
        at.position - truth(time) - Eigen::Vector3d(static_cast<double>(next), 0, 0);
    worst = std::max(worst, miss.norm());
    if (++next == tracks.size()) {
      next = 0;
      time += 0.002;
    }
  }
  state.counters["worst_m"] = worst;
  state.counters["octets"] = static_cast<double>(tracks[0].curve()->octets());
}
BENCHMARK_CAPTURE(follow_tracks, held, TrackTurn::held)->Arg(1)->Arg(10'000);
BENCHMARK_CAPTURE(follow_tracks, nose_ahead, TrackTurn::nose_ahead)->Arg(1)->Arg(10'000);

}  // namespace
}  // namespace reckon::peer
