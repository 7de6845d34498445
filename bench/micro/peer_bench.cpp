// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of clocks and tracks: the same row has the time of a call and the error of the results.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/clocks/peer_clock.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"
#include "reckon/peer/clocks/steady_utc.hpp"
#include "reckon/peer/tracks/entity_track.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kUtc = std::chrono::hours(500'000);

// Updates at 50 Hz with a delay of 20 ms and up to 10 ms more.
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
BENCHMARK_CAPTURE(map_timestamps, relative, false);  // error of the least transit, 20 ms

void hear_a_peer(benchmark::State& state) {
  const auto peers = static_cast<std::uint32_t>(state.range(0));
  PeerClocks clocks;
  pdu::DatagramTrailer trailer;
  for (trailer.epoch = 1; trailer.epoch < peers; ++trailer.epoch) {
    clocks.receive(trailer, kUtc, seconds(1));
  }
  nanoseconds now = seconds(1);
  for (auto _ : state) {
    now += milliseconds(1);
    trailer.send_time = pdu::trailer_time(kUtc + now - milliseconds(1));
    clocks.receive(trailer, kUtc + now, now);
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

// Positions of a number of entities, each on a track of its own, in turn: circles of 20 m, 0.1 s
// for each sample. The error is the distance of the position from the circle.
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
