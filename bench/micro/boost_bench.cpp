// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Region matching compared with Boost's packed R-tree, in alternation on the same regions: the tree
// is built from the updates and queried for each subscription. Both write their pairs into the same
// ring. The pairs of both are compared first, one by one. The second comparison is interest tick by
// tick, with the same tree rebuilt each tick and queried for each entity; the changes are compared
// one by one, each tick. The counters have the processor time of each, as medians, and the median
// of the rounds' ratios. Boost 1.74 warns about its own headers, which it still includes.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <benchmark/benchmark.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <ctime>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "reckon/bench/interest/incremental_interest.hpp"
#include "reckon/bench/interest/region_matching.hpp"
#include "reckon/bench/micro/moving_crowd.hpp"
#include "reckon/bench/micro/region_instances.hpp"
#include "reckon/bench/statistics/quantile.hpp"

namespace {

using namespace reckon;
namespace geometry = boost::geometry;

template <std::size_t D>
struct BoostTree {
  using Point = geometry::model::point<double, D, geometry::cs::cartesian>;
  using Box = geometry::model::box<Point>;
  using Value = std::pair<Box, std::uint32_t>;

  static Box box_of(const bench::Region<D>& region) {
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

  using Tree = geometry::index::rtree<Value, geometry::index::rstar<16>>;

  static Tree tree_of(const bench::RegionInstance<D>& made) {
    std::vector<Value> values;
    values.reserve(made.updates.size());
    for (std::uint32_t i = 0; i < made.updates.size(); ++i) {
      values.emplace_back(box_of(made.updates[i]), i);
    }
    return Tree(values);
  }

  template <typename Out>
  static void match(const bench::RegionInstance<D>& made, Out& out) {
    const Tree tree = tree_of(made);
    for (std::uint32_t i = 0; i < made.subscriptions.size(); ++i) {
      for (auto found = tree.qbegin(geometry::index::intersects(box_of(made.subscriptions[i])));
           found != tree.qend(); ++found) {
        out.put({i, found->second});
      }
    }
  }
};

template <std::size_t D, typename Out>
void match_ours(bench::RegionMatcher<D>& matcher, const bench::RegionInstance<D>& made, Out& out) {
  matcher.match(std::span<const bench::Region<D>>(made.subscriptions), made.updates,
                [&](auto some) { out.put(some); });
}

template <typename Work>
double milliseconds_of(const Work& work) {
  const std::clock_t before = std::clock();
  work();
  return 1e3 / CLOCKS_PER_SEC * static_cast<double>(std::clock() - before);
}

/// Whether both find the same updates for each subscription.
template <std::size_t D>
bool finds_the_same(bench::RegionMatcher<D>& matcher, const bench::RegionInstance<D>& made) {
  const std::span<const bench::Region<D>> subscriptions(made.subscriptions);
  std::vector<std::size_t> ends(made.subscriptions.size() + 1);
  matcher.match(subscriptions, made.updates, [&](std::span<const bench::RegionPair> some) {
    for (const bench::RegionPair& pair : some) ++ends[pair.subscription];
  });
  std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), std::size_t{0});
  std::vector<std::uint32_t> found(ends.back()), theirs;
  matcher.match(subscriptions, made.updates, [&](std::span<const bench::RegionPair> some) {
    for (const bench::RegionPair& pair : some) found[ends[pair.subscription]++] = pair.update;
  });
  const auto tree = BoostTree<D>::tree_of(made);
  for (std::size_t i = 0, begin = 0; i < subscriptions.size(); begin = ends[i++]) {
    theirs.clear();
    tree.query(geometry::index::intersects(BoostTree<D>::box_of(subscriptions[i])),
               boost::make_function_output_iterator(
                   [&](const auto& value) { theirs.push_back(value.second); }));
    const std::span<std::uint32_t> ours(found.data() + begin, ends[i] - begin);
    std::sort(ours.begin(), ours.end());
    std::sort(theirs.begin(), theirs.end());
    if (!std::equal(ours.begin(), ours.end(), theirs.begin(), theirs.end())) return false;
  }
  return true;
}

template <std::size_t D>
void regions_beside_boost(benchmark::State& state) {
  const bench::RegionInstance<D> made(static_cast<std::size_t>(state.range(0)),
                                      static_cast<double>(state.range(1)) / 100.0);
  bench::RegionMatcher<D> matcher;
  if (!finds_the_same(matcher, made)) state.SkipWithError("the two find different pairs");

  bench::PairRing ring;
  std::vector<double> ours_ms, boost_ms, ratios;
  for (auto _ : state) {
    ours_ms.push_back(milliseconds_of([&] { match_ours(matcher, made, ring); }));
    boost_ms.push_back(milliseconds_of([&] { BoostTree<D>::match(made, ring); }));
    ratios.push_back(boost_ms.back() / ours_ms.back());
  }
  benchmark::DoNotOptimize(ring);
  if (ratios.empty()) return;
  state.counters["ours_ms"] = bench::median(ours_ms);
  state.counters["boost_ms"] = bench::median(boost_ms);
  state.counters["ratio"] = bench::median(ratios);
}

void sizes(benchmark::internal::Benchmark* row) {
  row->ArgNames({"regions", "alpha_percent"})->Unit(benchmark::kMillisecond);
  for (const int count : {10000, 1000000}) {
    for (const int alpha_percent : {1, 100, 10000}) row->Args({count, alpha_percent});
  }
}
BENCHMARK_TEMPLATE(regions_beside_boost, 2)->Apply(sizes);
BENCHMARK_TEMPLATE(regions_beside_boost, 3)->Apply(sizes);

/// The entities in range of each entity, from a tree of this tick's positions.
struct HearingsOfBoost {
  using Point = geometry::model::point<double, 2, geometry::cs::cartesian>;
  using Value = std::pair<Point, std::uint32_t>;
  std::vector<std::size_t> ends;
  std::vector<std::uint32_t> heard;

  explicit HearingsOfBoost(const std::vector<aoim::Position>& places) {
    std::vector<Value> values;
    values.reserve(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      values.emplace_back(Point(places[i].x, places[i].y), i);
    }
    const geometry::index::rtree<Value, geometry::index::rstar<16>> tree(values);
    constexpr double kRadius = bench::MovingCrowd::kRadius;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      const aoim::Position& own = places[i];
      const geometry::model::box<Point> box(Point(own.x - 1.01 * kRadius, own.y - 1.01 * kRadius),
                                            Point(own.x + 1.01 * kRadius, own.y + 1.01 * kRadius));
      const std::size_t begin = heard.size();
      tree.query(geometry::index::intersects(box),
                 boost::make_function_output_iterator([&](const Value& value) {
                   const aoim::Position& other = places[value.second];
                   const double x = other.x - own.x, y = other.y - own.y;
                   if (value.second != i && x * x + y * y <= kRadius * kRadius) {
                     heard.push_back(value.second);
                   }
                 }));
      std::sort(heard.begin() + static_cast<std::ptrdiff_t>(begin), heard.end());
      ends.push_back(heard.size());
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return {heard.data() + begin, ends[i] - begin};
  }
  [[nodiscard]] std::vector<bench::HearingChange> since(const HearingsOfBoost& before) const {
    std::vector<bench::HearingChange> changes;
    for (std::uint32_t i = 0; i < ends.size(); ++i) {
      const auto now = of(i), then = before.of(i);
      for (auto a = now.begin(), b = then.begin(); a != now.end() || b != then.end();) {
        if (b == then.end() || (a != now.end() && *a < *b)) {
          changes.push_back({i, *a++, true});
        } else if (a == now.end() || *b < *a) {
          changes.push_back({i, *b++, false});
        } else {
          ++a;
          ++b;
        }
      }
    }
    return changes;
  }
};

void hearings_beside_boost(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  bench::MovingCrowd crowd(count, 100);
  bench::IncrementalInterest interest = bench::interest_of(crowd);
  HearingsOfBoost before(crowd.positions());
  std::vector<double> ours_ns, boost_ns, ratios;
  for (auto _ : state) {
    crowd.walk([](std::uint32_t, const aoim::Position&) {});
    std::span<const bench::HearingChange> told;
    ours_ns.push_back(1e6 / count * milliseconds_of([&] {
                        for (std::uint32_t i = 0; i < count; ++i)
                          interest.move(i, crowd.positions()[i]);
                        told = interest.step();
                      }));
    std::vector<bench::HearingChange> theirs;
    boost_ns.push_back(1e6 / count * milliseconds_of([&] {
                         HearingsOfBoost now(crowd.positions());
                         theirs = now.since(before);
                         std::swap(before, now);
                       }));
    if (!std::equal(told.begin(), told.end(), theirs.begin(), theirs.end())) {
      state.SkipWithError("the two tell different changes");
      return;
    }
    ratios.push_back(boost_ns.back() / ours_ns.back());
  }
  if (ratios.empty()) return;
  state.counters["ours_ns"] = bench::median(ours_ns);
  state.counters["boost_ns"] = bench::median(boost_ns);
  state.counters["ratio"] = bench::median(ratios);
}
BENCHMARK(hearings_beside_boost)
    ->ArgName("entities")
    ->Arg(10000)
    ->Arg(1000000)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace
