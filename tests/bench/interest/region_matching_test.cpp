// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/region_matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace reckon::bench::region_matching_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <std::size_t D>
using Regions = std::vector<Region<D>>;
using PairList = std::vector<RegionPair>;

/// Every pair, sorted, by comparing each region with each.
template <std::size_t D>
PairList brute_force(const Regions<D>& subscriptions, const Regions<D>& updates) {
  PairList pairs;
  for (std::size_t s = 0; s < subscriptions.size(); ++s) {
    for (std::size_t u = 0; u < updates.size(); ++u) {
      bool meet = true;
      for (std::size_t axis = 0; axis < D; ++axis) {
        const double from = std::max(subscriptions[s].lower[axis], updates[u].lower[axis]);
        const double to = std::min(subscriptions[s].upper[axis], updates[u].upper[axis]);
        const bool both = subscriptions[s].lower[axis] < subscriptions[s].upper[axis] &&
                          updates[u].lower[axis] < updates[u].upper[axis];
        meet = meet && both && from < to;
      }
      if (meet) pairs.push_back({static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(u)});
    }
  }
  return pairs;
}

template <std::size_t D>
PairList matched(RegionMatcher<D>& matcher, const Regions<D>& subscriptions,
                 const Regions<D>& updates) {
  PairList pairs;
  const RegionMatch found = matcher.match(std::span<const Region<D>>(subscriptions), updates,
                                          [&](std::span<const RegionPair> some) {
                                            EXPECT_LE(some.size(), matcher.kMostAtOnce);
                                            pairs.insert(pairs.end(), some.begin(), some.end());
                                          });
  EXPECT_EQ(found.pairs, pairs.size());
  return pairs;
}

template <std::size_t D>
PairList sorted_match(const Regions<D>& subscriptions, const Regions<D>& updates) {
  RegionMatcher<D> matcher;
  PairList pairs = matched(matcher, subscriptions, updates);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

enum class Layout { even, crowds, all_sizes, long_and_thin, lattice };

template <std::size_t D>
Regions<D> made(Layout layout, std::size_t count, double side, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> scatter(0.0, 1e-6);
  Regions<D> regions(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double crowd = static_cast<double>(random() % 4) * 1e6;
    for (std::size_t axis = 0; axis < D; ++axis) {
      double lower = unit(random), length = side;
      if (layout == Layout::crowds) {
        lower = crowd + scatter(random);
        length = 1e-8 * side;
      } else if (layout == Layout::all_sizes) {
        length = side * std::pow(10.0, 6.0 * unit(random) - 5.0);
      } else if (layout == Layout::long_and_thin) {
        length = (random() & 1) != 0 ? 0.01 * side : (random() % 8 == 0 ? 1.0 : side);
      } else if (layout == Layout::lattice) {
        lower = std::floor(8.0 * lower) / 8.0;
        length = 0.125;
      }
      regions[i].lower[axis] = lower;
      regions[i].upper[axis] = lower + length;
    }
  }
  return regions;
}

template <std::size_t D>
void expect_exact(Layout layout, std::size_t count, double side, std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << D << "-D, layout " << static_cast<int>(layout) << ", " << count
                                  << " regions of " << side << ", seed " << seed);
  std::mt19937_64 random(seed);
  const Regions<D> subscriptions = made<D>(layout, count, side, random);
  const Regions<D> updates = made<D>(layout, count + seed % 3, side, random);
  EXPECT_EQ(sorted_match(subscriptions, updates), brute_force(subscriptions, updates));
}

TEST(RegionMatching, EqualsBruteForceForAllLayouts) {
  for (const Layout layout :
       {Layout::even, Layout::crowds, Layout::all_sizes, Layout::long_and_thin, Layout::lattice}) {
    std::uint64_t seed = 1;
    for (const std::size_t count : {1, 7, 33, 200, 800}) {
      for (const double side : {0.001, 0.03, 0.3}) {
        expect_exact<1>(layout, count, side, ++seed);
        expect_exact<2>(layout, count, side, ++seed);
        expect_exact<3>(layout, count, side, ++seed);
      }
    }
  }
}

TEST(RegionMatching, EqualsBruteForceOnSamplesOfManyRegions) {
  std::mt19937_64 random(5);
  const Regions<2> subscriptions = made<2>(Layout::even, 50000, 0.01, random);
  const Regions<2> updates = made<2>(Layout::all_sizes, 50000, 0.01, random);
  const PairList all = sorted_match(subscriptions, updates);
  ASSERT_GT(all.size(), 50000u);
  for (std::uint32_t s = 0; s < subscriptions.size(); s += 997) {
    PairList own = brute_force<2>({subscriptions[s]}, updates);
    for (RegionPair& pair : own) pair.subscription = s;
    const auto begin = std::lower_bound(all.begin(), all.end(), RegionPair{s, 0});
    const auto end = std::lower_bound(all.begin(), all.end(), RegionPair{s + 1, 0});
    EXPECT_EQ(PairList(begin, end), own) << "subscription " << s;
  }
}

TEST(RegionMatching, UpperBoundsAreExclusive) {
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_EQ(sorted_match<1>({{{0.0}, {1.0}}}, {{{1.0}, {2.0}}}), PairList{});
  EXPECT_EQ(sorted_match<1>({{{0.0}, {next}}}, {{{1.0}, {2.0}}}), (PairList{{0, 0}}));
  EXPECT_EQ(sorted_match<1>({{{1.0}, {next}}}, {{{1.0}, {next}}}), (PairList{{0, 0}}));
}

TEST(RegionMatching, ReportsTheRefusedRegions) {
  const Regions<2> subscriptions = {
      {{0, 0}, {1, 1}}, {{0, 1}, {1, 0}}, {{0, 0}, {kNan, 1}}, {{0, 0}, {0, 1}}};
  const Regions<2> updates = {{{0, kNan}, {1, 1}}, {{0.5, 0.5}, {2, 2}}};
  RegionMatcher<2> matcher;
  PairList pairs;
  const RegionMatch found = matcher.match(
      std::span<const Region<2>>(subscriptions), updates,
      [&](std::span<const RegionPair> some) { pairs.assign(some.begin(), some.end()); });
  EXPECT_EQ(pairs, (PairList{{0, 1}}));
  EXPECT_EQ(found.subscriptions.count, 3u);
  EXPECT_EQ(found.subscriptions.first, 1u);
  EXPECT_EQ(found.subscriptions.fault, RegionFault::empty);
  EXPECT_EQ(found.updates.count, 1u);
  EXPECT_EQ(found.updates.first, 0u);
  EXPECT_EQ(found.updates.fault, RegionFault::not_a_number);
}

TEST(RegionMatching, TakesInfiniteAndHugeBounds) {
  std::mt19937_64 random(9);
  Regions<2> subscriptions = made<2>(Layout::even, 300, 0.05, random), updates = subscriptions;
  for (Regions<2>* regions : {&subscriptions, &updates}) {
    regions->push_back({{-kInfinity, -kInfinity}, {kInfinity, kInfinity}});
    regions->push_back({{-kInfinity, 0.2}, {kInfinity, 0.21}});
    regions->push_back({{0.5, -kInfinity}, {0.6, -1e300}});
    regions->push_back({{-1e308, -1e308}, {1e308, 1e308}});
    regions->push_back({{1e300, 1e300}, {1.1e300, kInfinity}});
    regions->push_back({{-5.0, -5.0}, {-4.0, -4.0}});
  }
  EXPECT_EQ(sorted_match(subscriptions, updates), brute_force(subscriptions, updates));
}

TEST(RegionMatching, EmptySetsHaveNoPairs) {
  EXPECT_EQ(sorted_match<3>({}, {{{0, 0, 0}, {1, 1, 1}}}), PairList{});
  EXPECT_EQ(sorted_match<3>({{{0, 0, 0}, {1, 1, 1}}}, {}), PairList{});
}

TEST(RegionMatching, AllSimdLevelsGiveTheSamePairs) {
  std::mt19937_64 random(3);
  const Regions<3> subscriptions = made<3>(Layout::all_sizes, 900, 0.4, random);
  const Regions<3> updates = made<3>(Layout::even, 900, 0.2, random);
  RegionMatcher<3> scalar(SimdLevel::scalar);
  const PairList expected = matched(scalar, subscriptions, updates);
  ASSERT_GT(expected.size(), 1000u);
  for (const SimdLevel level : {SimdLevel::avx2, SimdLevel::avx512}) {
    RegionMatcher<3> matcher(level);
    EXPECT_EQ(matched(matcher, subscriptions, updates), expected)
        << "level " << static_cast<int>(level);
  }
}

TEST(RegionMatching, MemoryFollowsTheNumberOfRegions) {
  constexpr std::size_t kCount = 20000;
  for (const Layout layout : {Layout::even, Layout::crowds, Layout::long_and_thin}) {
    std::mt19937_64 random(11);
    Regions<2> subscriptions = made<2>(layout, kCount, 1e-6, random);
    Regions<2> updates = made<2>(layout, kCount, 1e-6, random);
    updates.push_back({{-1e9, -1e9}, {1e9, 1e9}});
    updates.push_back({{1e12, 1e12}, {1e12 + 1, 1e12 + 1}});
    RegionMatcher<2> matcher;
    matched(matcher, subscriptions, updates);
    EXPECT_LT(matcher.memory(), (24 * 2 + 24) * (2 * kCount + 2) + 300000);
  }
}

TEST(RegionMatching, ContinuesAfterASinkThatThrew) {
  std::mt19937_64 random(2);
  const Regions<1> regions = made<1>(Layout::even, 2000, 0.1, random);
  RegionMatcher<1> matcher;
  const std::span<const Region<1>> all(regions);
  EXPECT_THROW(matcher.match(all, all, [](auto) { throw std::runtime_error("full"); }),
               std::runtime_error);
  PairList pairs = matched(matcher, regions, regions);
  std::sort(pairs.begin(), pairs.end());
  EXPECT_EQ(pairs, brute_force(regions, regions));
}

}  // namespace
}  // namespace reckon::bench::region_matching_test
