// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Region matching beside Boost's packed R-tree, in turn on the same regions: the tree is built of
// the updates and asked for each subscription. Both write their pairs into the same ring. That both
// find the same pairs is seen first. The counters hold the processor time of each, medians, and the
// median of the rounds' ratios.
// Boost 1.74 tells of headers of its own that it still includes.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <benchmark/benchmark.h>

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <ctime>
#include <utility>
#include <vector>

#include "reckon/aoim/interest/region_matching.hpp"
#include "reckon/bench/region_instances.hpp"

namespace {

using namespace reckon;
namespace geometry = boost::geometry;

template <std::size_t D>
struct BoostTree {
  using Point = geometry::model::point<double, D, geometry::cs::cartesian>;
  using Box = geometry::model::box<Point>;
  using Value = std::pair<Box, std::uint32_t>;

  static Box box_of(const aoim::Region<D>& region) {
    Point lower, upper;
    geometry::set<0>(lower, region.lower[0]);
    geometry::set<0>(upper, region.upper[0]);
    geometry::set<1>(lower, region.lower[1]);
    geometry::set<1>(upper, region.upper[1]);
    if constexpr (D > 2) {
      geometry::set<2>(lower, region.lower[2]);
      geometry::set<2>(upper, region.upper[2]);
    }
    return {lower, upper};
  }

  template <typename Out>
  static void match(const bench::RegionInstance<D>& made, Out& out) {
    std::vector<Value> values;
    values.reserve(made.updates.size());
    for (std::uint32_t i = 0; i < made.updates.size(); ++i) {
      values.emplace_back(box_of(made.updates[i]), i);
    }
    const geometry::index::rtree<Value, geometry::index::rstar<16>> tree(values);
    for (std::uint32_t i = 0; i < made.subscriptions.size(); ++i) {
      for (auto found = tree.qbegin(geometry::index::intersects(box_of(made.subscriptions[i])));
           found != tree.qend(); ++found) {
        out.put({i, found->second});
      }
    }
  }
};

template <std::size_t D, typename Out>
void match_ours(aoim::RegionMatcher<D>& matcher, const bench::RegionInstance<D>& made, Out& out) {
  matcher.match(std::span<const aoim::Region<D>>(made.subscriptions), made.updates,
                [&](auto some) { out.put(some); });
}

template <typename Work>
double milliseconds_of(const Work& work) {
  const std::clock_t before = std::clock();
  work();
  return 1e3 / CLOCKS_PER_SEC * static_cast<double>(std::clock() - before);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <std::size_t D>
void regions_beside_boost(benchmark::State& state) {
  const bench::RegionInstance<D> made(static_cast<std::size_t>(state.range(0)),
                                      static_cast<double>(state.range(1)) / 100.0);
  aoim::RegionMatcher<D> matcher;
  bench::PairSum ours, theirs;
  match_ours(matcher, made, ours);
  BoostTree<D>::match(made, theirs);
  if (!(ours == theirs)) state.SkipWithError("the two find different pairs");

  bench::PairRing ring;
  std::vector<double> ours_ms, boost_ms, ratios;
  for (auto _ : state) {
    ours_ms.push_back(milliseconds_of([&] { match_ours(matcher, made, ring); }));
    boost_ms.push_back(milliseconds_of([&] { BoostTree<D>::match(made, ring); }));
    ratios.push_back(boost_ms.back() / ours_ms.back());
  }
  benchmark::DoNotOptimize(ring);
  if (ratios.empty()) return;
  state.counters["ours_ms"] = median(ours_ms);
  state.counters["boost_ms"] = median(boost_ms);
  state.counters["ratio"] = median(ratios);
}

void sizes(benchmark::internal::Benchmark* row) {
  row->ArgNames({"regions", "alpha_percent"})->Unit(benchmark::kMillisecond);
  for (const int count : {10000, 1000000}) {
    for (const int alpha_percent : {1, 100, 10000}) row->Args({count, alpha_percent});
  }
}
BENCHMARK_TEMPLATE(regions_beside_boost, 2)->Apply(sizes);
BENCHMARK_TEMPLATE(regions_beside_boost, 3)->Apply(sizes);

}  // namespace
