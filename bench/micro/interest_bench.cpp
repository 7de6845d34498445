// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Incremental interest: processor time of a tick, including moves and sorted changes, for each
// entity: the mean and the maximum of the ticks after the first 40. Also checks the changes against
// a comparison of all pairs.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <utility>
#include <vector>

#include "reckon/bench/interest/incremental_interest.hpp"
#include "reckon/bench/micro/moving_crowd.hpp"

namespace {

using namespace reckon;

void tick_of_crowd(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  bench::MovingCrowd crowd(count, static_cast<unsigned>(state.range(1)));
  bench::IncrementalInterest interest = bench::interest_of(crowd);
  std::vector<std::pair<std::uint32_t, aoim::Position>> moves;
  double total = 0, worst = 0, changes = 0;
  std::size_t ticks = 0;
  const auto tick = [&] {
    moves.clear();
    crowd.walk([&](std::uint32_t i, const aoim::Position& to) { moves.emplace_back(i, to); });
    const std::clock_t before = std::clock();
    for (const auto& [entity, to] : moves) interest.move(entity, to);
    changes += static_cast<double>(interest.step().size());
    const double ns = 1e9 / CLOCKS_PER_SEC * static_cast<double>(std::clock() - before);
    total += ns;
    worst = std::max(worst, ns);
    ++ticks;
    return ns;
  };
  for (int i = 0; i < 40; ++i) tick();
  total = worst = changes = 0;
  ticks = 0;
  for (auto _ : state) state.SetIterationTime(1e-9 * tick());
  const double each = static_cast<double>(ticks) * count;
  state.counters["mean_ns"] = total / each;
  state.counters["worst_ns"] = worst / count;
  state.counters["changes"] = changes / each;
  state.counters["octets"] = static_cast<double>(interest.memory()) / count;
}
BENCHMARK(tick_of_crowd)
    ->ArgNames({"entities", "percent_moving"})
    ->Args({10000, 100})
    ->Args({10000, 10})
    ->Args({100000, 100})
    ->Args({1000000, 100})
    ->Args({1000000, 10})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

bool hears(const aoim::Position& a, const aoim::Position& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  return x * x + y * y <= bench::MovingCrowd::kRadius * bench::MovingCrowd::kRadius;
}

// All pairs, at each tick: the changes since the last tick, in order.
void tick_beside_brute_force(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  bench::MovingCrowd crowd(count, 100);
  bench::IncrementalInterest interest = bench::interest_of(crowd);
  double changes = 0;
  for (auto _ : state) {
    const std::vector<aoim::Position> before = crowd.positions();
    crowd.walk([&](std::uint32_t i, const aoim::Position& to) { interest.move(i, to); });
    const std::vector<aoim::Position>& now = crowd.positions();
    std::vector<bench::HearingChange> expected;
    for (std::uint32_t a = 0; a < count; ++a) {
      for (std::uint32_t b = 0; b < count; ++b) {
        const bool heard = hears(now[a], now[b]);
        if (heard != hears(before[a], before[b])) expected.push_back({a, b, heard});
      }
    }
    const auto told = interest.step();
    changes += static_cast<double>(told.size());
    if (!std::equal(told.begin(), told.end(), expected.begin(), expected.end())) {
      state.SkipWithError("it tells other changes than brute force");
      return;
    }
  }
  state.counters["changes"] = changes;
}
BENCHMARK(tick_beside_brute_force)
    ->ArgName("entities")
    ->Arg(10000)
    ->Arg(100000)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace
