// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Region matching: the time of a complete match with written pairs, by dimensions, regions and
// alpha.
#include <benchmark/benchmark.h>

#include "reckon/bench/interest/region_matching.hpp"
#include "reckon/bench/micro/region_instances.hpp"

namespace {

using namespace reckon;

template <std::size_t D>
void match_regions(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const double alpha = static_cast<double>(state.range(1)) / 100.0;
  const bench::RegionInstance<D> made(count, alpha);
  const std::span<const bench::Region<D>> subscriptions(made.subscriptions);
  bench::RegionMatcher<D> matcher;
  bench::PairRing ring;
  std::uint64_t pairs = 0;
  for (auto _ : state) {
    pairs = matcher.match(subscriptions, made.updates, [&](auto some) { ring.put(some); }).pairs;
  }
  benchmark::DoNotOptimize(ring);
  state.counters["pairs"] = static_cast<double>(pairs);
  state.counters["MB"] = 1e-6 * static_cast<double>(matcher.memory());
}

void sizes(benchmark::internal::Benchmark* row) {
  row->ArgNames({"regions", "alpha_percent"})->Unit(benchmark::kMillisecond);
  for (const int count : {10000, 1000000}) {
    for (const int alpha_percent : {1, 100, 10000}) row->Args({count, alpha_percent});
  }
}
BENCHMARK_TEMPLATE(match_regions, 1)->Apply(sizes);
BENCHMARK_TEMPLATE(match_regions, 2)->Apply(sizes);
BENCHMARK_TEMPLATE(match_regions, 3)->Apply(sizes);

}  // namespace
