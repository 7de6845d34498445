// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The aggregator against the closed forms of hybrid (quorum or time-out) bundling of Poisson
// arrivals, docs/area_of_interest.md.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

struct Setting {
  double rate;         ///< L [1/s]
  double timeout;      ///< T [s]
  std::size_t quorum;  ///< n; 0 = by size alone, which is 8 bare Entity States
};

struct Means {
  double bundle = 0.0;  ///< K
  double delay = 0.0;   ///< [s]
  double worst = 0.0;   ///< [s]
};

Means closed_form(const Setting& setting) {
  const std::size_t n = setting.quorum == 0 ? 8 : setting.quorum;
  const double a = setting.rate * setting.timeout;
  double term = std::exp(-a), below = 0.0;  // P(N = j), P(N < i)
  double bundle = 1.0, waited = 0.0;
  for (std::size_t i = 1; i < n; ++i) {
    below += term;
    term *= a / static_cast<double>(i);
    bundle += 1.0 - below;
    waited += static_cast<double>(i) * (1.0 - below);
  }
  return {bundle, waited / (setting.rate * bundle), setting.timeout};
}

/// Runs Poisson arrivals through the aggregator, called exactly when it asks to be.
Means measured(const Setting& setting, int updates) {
  AggregatorConfig config;
  config.maximum_updates = setting.quorum;
  Aggregator aggregator(config);
  std::mt19937_64 random(20260101);
  std::exponential_distribution<double> gap(setting.rate);
  std::vector<nanoseconds> arrived(65536);
  nanoseconds now{0}, worst{0};
  double delays = 0.0;
  int left = 0, datagrams = 0;
  const auto sink = [&](GroupIndex, std::span<const std::byte> datagram) {
    ++datagrams;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      if (bundled.header.pdu_type != pdu::PduType::entity_state) continue;
      const auto id = pdu::load_big_endian<std::uint16_t>(bundled.bytes.data() + 16);
      worst = std::max(worst, now - arrived[id]);
      delays += std::chrono::duration<double>(now - arrived[id]).count();
      ++left;
    }
  };
  const auto timeout =
      std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(setting.timeout));
  double clock = 0.0;
  for (int i = 0; i < updates; ++i) {
    clock += gap(random);
    const auto arrival =
        std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(clock));
    while (aggregator.next_deadline() && *aggregator.next_deadline() <= arrival) {
      now = *aggregator.next_deadline();
      aggregator.flush_due(now, sink);
    }
    now = arrival;
    const auto id = static_cast<std::uint16_t>(i & 0xFFFF);
    arrived[id] = now;
    aggregator.add(GroupIndex{1}, entity_state(id), {}, now + timeout);
    aggregator.flush_due(now, sink);
  }
  return {static_cast<double>(left) / datagrams, delays / left,
          std::chrono::duration<double>(worst).count()};
}

class AggregatorTheory : public ::testing::TestWithParam<Setting> {};

TEST_P(AggregatorTheory, MeetsTheClosedFormsWithinTwoPercentAndNeverExceedsTheTimeOut) {
  const Setting setting = GetParam();
  const Means expected = closed_form(setting);
  const Means actual = measured(setting, 100000);
  std::printf("L %6.0f /s, T %5.1f ms, n %zu: K %.3f (closed form %.3f), delay %.4f ms (%.4f)\n",
              setting.rate, 1e3 * setting.timeout, setting.quorum, actual.bundle, expected.bundle,
              1e3 * actual.delay, 1e3 * expected.delay);
  EXPECT_NEAR(actual.bundle, expected.bundle, 0.02 * expected.bundle);
  EXPECT_NEAR(actual.delay, expected.delay, 0.02 * expected.delay);
  EXPECT_LE(actual.worst, setting.timeout);
}

INSTANTIATE_TEST_SUITE_P(Settings, AggregatorTheory,
                         ::testing::Values(Setting{100, 0.005, 0}, Setting{500, 0.005, 0},
                                           Setting{500, 0.010, 0}, Setting{2000, 0.002, 0},
                                           Setting{2000, 0.005, 0}, Setting{10000, 0.010, 0},
                                           Setting{500, 0.010, 5}, Setting{1000, 0.003, 3},
                                           Setting{1000, 0.005, 2}, Setting{5000, 0.001, 6},
                                           Setting{300, 0.030, 7}, Setting{50, 0.030, 4}));

}  // namespace
}  // namespace reckon::aoim
