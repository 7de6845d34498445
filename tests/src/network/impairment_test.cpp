// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/impairment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>

#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr std::uint64_t kMany = 1'000'000;

double share_lost(const Impairment& impairment, std::uint64_t sender, Fate::Loss kind) {
  std::uint64_t lost = 0;
  for (std::uint64_t i = 0; i < kMany; ++i) lost += impairment.decide(sender, i, 0ns).loss == kind;
  return static_cast<double>(lost) / static_cast<double>(kMany);
}

// Five standard deviations of a share among kMany independent trials.
double five_sigma(double share) {
  return 5.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(kMany));
}

ImpairmentLaw everything() {
  ImpairmentLaw law;
  law.delay = 20ms;
  law.jitter = 5ms;
  law.loss = 0.02;
  law.burst_loss = 0.05;
  law.burst_length = 4.0;
  law.reorder = 0.03;
  law.duplicate = 0.01;
  law.outages = {{10s, 500ms, 60s}};
  return law;
}

TEST(Impairment, OfNothingPassesEverythingAtOnce) {
  EXPECT_TRUE(ImpairmentLaw{}.is_perfect());
  const Impairment impairment({}, 7);
  for (std::uint64_t i = 0; i < 1000; ++i) EXPECT_EQ(impairment.decide(1, i, 0ns), Fate{});
}

TEST(Impairment, DependsOnItsArgumentsOnly) {
  const Impairment forward(everything(), 42), other(everything(), 42);
  std::vector<Fate> fates;
  for (std::uint64_t i = 0; i < 20000; ++i) fates.push_back(forward.decide(3, i, i * 1ms));
  std::vector<std::uint64_t> order(fates.size());
  for (std::uint64_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937_64(1));
  for (const std::uint64_t i : order) ASSERT_EQ(other.decide(3, i, i * 1ms), fates[i]) << i;
}

// The decisions belong to the meaning of a seed: a change here makes old seeds different runs.
TEST(Impairment, KeepsItsDecisionsFromVersionToVersion) {
  const Impairment impairment(everything(), 42);
  std::uint64_t sum = 0xcbf29ce484222325u;
  const auto mix = [&sum](std::uint64_t value) { sum = (sum ^ value) * 0x100000001b3u; };
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Fate fate = impairment.decide(i % 3, i, i * 1ms);
    mix(fate.copies);
    mix(static_cast<std::uint64_t>(fate.loss));
    mix(static_cast<std::uint64_t>(fate.delay[0].count()));
    mix(static_cast<std::uint64_t>(fate.delay[1].count()));
  }
  EXPECT_EQ(sum, 0x81f84611aa3e406du) << std::hex << sum;
}

TEST(Impairment, LosesTheShareAskedFor) {
  for (const double loss : {0.001, 0.02, 0.3, 1.0}) {
    ImpairmentLaw law;
    law.loss = loss;
    const double measured = share_lost(Impairment(law, 5), 0, Fate::Loss::random);
    EXPECT_NEAR(measured, loss, five_sigma(loss));
  }
}

TEST(Impairment, LosesInBurstsOfTheLengthAskedFor) {
  for (const auto& [share, length] : {std::pair{0.02, 5.0}, {0.2, 3.0}, {0.3, 50.0}, {0.6, 1.6}}) {
    ImpairmentLaw law;
    law.burst_loss = share;
    law.burst_length = length;
    const Impairment impairment(law, 11);
    std::uint64_t lost = 0, bursts = 0;
    bool before = false;
    for (std::uint64_t i = 0; i < kMany; ++i) {
      const bool now = impairment.decide(0, i, 0ns).loss == Fate::Loss::burst;
      lost += now;
      bursts += now && !before;
      before = now;
    }
    const double mean = static_cast<double>(lost) / static_cast<double>(bursts);
    // The variance grows by (1 + c) / (1 - c) with the correlation c of neighbours.
    const double c = 1.0 - 1.0 / length - share / (1.0 - share) / length;
    const double sigma5 = five_sigma(share) * std::sqrt((1.0 + c) / (1.0 - c));
    EXPECT_NEAR(static_cast<double>(lost) / static_cast<double>(kMany), share, sigma5);
    EXPECT_NEAR(mean, length, 6.0 * length / std::sqrt(static_cast<double>(bursts)));
  }
}

TEST(Impairment, MatchesTheBurstChainStepByStep) {
  // From one state to the next the chain must obey its own transition probabilities.
  ImpairmentLaw law;
  law.burst_loss = 0.1;
  law.burst_length = 8.0;
  const Impairment impairment(law, 3);
  double entered = 0, good = 0, left = 0, bad = 0;
  bool before = impairment.decide(0, 0, 0ns).copies == 0;
  for (std::uint64_t i = 1; i < kMany; ++i) {
    const bool now = impairment.decide(0, i, 0ns).copies == 0;
    (before ? bad : good) += 1;
    if (before && !now) left += 1;
    if (!before && now) entered += 1;
    before = now;
  }
  EXPECT_NEAR(left / bad, 1.0 / 8.0, 0.006);
  EXPECT_NEAR(entered / good, 1.0 / 72.0, 0.0007);
}

TEST(Impairment, DelaysUniformlyAroundTheBase) {
  ImpairmentLaw law;
  law.delay = 20ms;
  law.jitter = 5ms;
  const Impairment impairment(law, 9);
  std::vector<double> delays;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    delays.push_back(static_cast<double>(impairment.decide(2, i, 0ns).delay[0].count()) * 1e-6);
  }
  std::sort(delays.begin(), delays.end());
  EXPECT_GE(delays.front(), 15.0);
  EXPECT_LE(delays.back(), 25.0);
  double worst = 0.0;  // Kolmogorov-Smirnov distance; 1.95 / sqrt(n) is exceeded once in 1000
  for (std::size_t i = 0; i < delays.size(); ++i) {
    const double expected = (delays[i] - 15.0) / 10.0;
    worst = std::max(worst, std::abs(expected - static_cast<double>(i) / 1e5));
  }
  EXPECT_LT(worst, 1.95 / std::sqrt(1e5));
}

TEST(ImpairmentLaw, IsMadeOfSecondsAndShares) {
  const ImpairmentLaw law = delayed_by(0.08, 0.4, 0.1);
  EXPECT_EQ(law.delay, 80ms);
  EXPECT_EQ(law.jitter, 32ms);
  EXPECT_EQ(law.loss, 0.1);
  EXPECT_EQ(jitter_share(law), 0.4);
  EXPECT_EQ(jitter_share(delayed_by(0)), 0);
}

TEST(Impairment, NeverDeliversBeforeItWasSent) {
  ImpairmentLaw law;
  law.delay = 1ms;
  law.jitter = 10ms;
  const Impairment impairment(law, 9);
  for (std::uint64_t i = 0; i < 10'000; ++i) EXPECT_GE(impairment.decide(0, i, 0ns).delay[0], 0ns);
}

TEST(Impairment, HoldsBackAndDoublesTheSharesAskedFor) {
  ImpairmentLaw law;
  law.delay = 1ms;
  law.reorder = 0.04;
  law.reorder_delay = 7ms;
  law.duplicate = 0.1;
  const Impairment impairment(law, 13);
  double late = 0, twice = 0;
  for (std::uint64_t i = 0; i < kMany; ++i) {
    const Fate fate = impairment.decide(0, i, 0ns);
    late += fate.delay[0] == 8ms;
    twice += fate.copies == 2;
    ASSERT_TRUE(fate.delay[0] == 1ms || fate.delay[0] == 8ms);
  }
  EXPECT_NEAR(late / kMany, 0.04, five_sigma(0.04));
  EXPECT_NEAR(twice / kMany, 0.1, five_sigma(0.1));
}

TEST(Impairment, LetsNothingPassInAnOutage) {
  ImpairmentLaw law;
  law.outages = {{2s, 300ms, 0ns}, {10s, 1s, 5s}};
  const Impairment impairment(law, 1);
  const auto passes = [&](nanoseconds time) { return impairment.decide(0, 0, time).copies == 1; };
  EXPECT_TRUE(passes(2s - 1ns));
  EXPECT_FALSE(passes(2s));
  EXPECT_FALSE(passes(2300ms - 1ns));
  EXPECT_TRUE(passes(2300ms));
  EXPECT_TRUE(passes(7s));
  EXPECT_FALSE(passes(10s));
  EXPECT_TRUE(passes(11s));
  EXPECT_FALSE(passes(25s));
  EXPECT_EQ(impairment.decide(0, 0, 10s).loss, Fate::Loss::outage);
}

TEST(Impairment, TreatsSendersSeedsAndReceiversIndependently) {
  ImpairmentLaw law;
  law.loss = 0.5;
  const Impairment a(law, direction_seed(1, 0)), b(law, direction_seed(1, 1));
  double receivers = 0, senders = 0, neighbours = 0;
  for (std::uint64_t i = 0; i < kMany; ++i) {
    const bool lost = a.decide(0, i, 0ns).copies == 0;
    receivers += lost == (b.decide(0, i, 0ns).copies == 0);
    senders += lost == (a.decide(1, i, 0ns).copies == 0);
    neighbours += lost == (a.decide(0, i + 1, 0ns).copies == 0);
  }
  EXPECT_NEAR(receivers / kMany, 0.5, five_sigma(0.5));
  EXPECT_NEAR(senders / kMany, 0.5, five_sigma(0.5));
  EXPECT_NEAR(neighbours / kMany, 0.5, five_sigma(0.5));
}

TEST(Impairment, RefusesALawOutOfRange) {
  const auto refused = [](auto change) {
    ImpairmentLaw law;
    change(law);
    EXPECT_FALSE(law.problem().empty());
    EXPECT_THROW(Impairment(law, 1), std::invalid_argument);
  };
  refused([](ImpairmentLaw& law) { law.loss = -0.1; });
  refused([](ImpairmentLaw& law) { law.loss = 1.1; });
  refused([](ImpairmentLaw& law) { law.loss = std::numeric_limits<double>::quiet_NaN(); });
  refused([](ImpairmentLaw& law) { law.burst_loss = 1.0; });
  refused([](ImpairmentLaw& law) { law.burst_length = 0.5; });
  refused([](ImpairmentLaw& law) { law.burst_loss = 0.9, law.burst_length = 1.0; });
  refused([](ImpairmentLaw& law) { law.delay = -1ns; });
  refused([](ImpairmentLaw& law) { law.jitter = 2h; });
  refused([](ImpairmentLaw& law) { law.duplicate = 2.0; });
  refused([](ImpairmentLaw& law) { law.outages = {{0s, -1s, 0s}}; });
}

TEST(Impairment, DecidesWithoutAllocating) {
  const Impairment impairment(everything(), 42);
  const test::AllocationGuard guard;
  std::uint64_t copies = 0;
  for (std::uint64_t i = 0; i < 10'000; ++i) copies += impairment.decide(0, i, i * 1ms).copies;
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_GT(copies, 0u);
}

// A figure for docs/transport.md, not a criterion.
TEST(Impairment, MeasuredCostOfADecision) {
  for (const bool all : {false, true}) {
    ImpairmentLaw law = everything();
    if (!all) law.burst_loss = 0.0;
    const Impairment impairment(law, 42);
    std::uint64_t copies = 0;
    const std::clock_t start = std::clock();
    for (std::uint64_t i = 0; i < kMany; ++i) copies += impairment.decide(0, i, 0ns).copies;
    const double spent = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::cout << (all ? "with" : "without") << " bursts of 4 (5 %): " << spent * 1e9 / kMany
              << " ns CPU a decision\n";
    EXPECT_GT(copies, kMany / 2);
  }
}

}  // namespace
}  // namespace reckon::peer
