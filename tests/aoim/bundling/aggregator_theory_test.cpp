// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The aggregator against the closed forms of time-out, quorum and hybrid bundling of Poisson
// arrivals, docs/area_of_interest_mechanisms.md.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr std::size_t kLargest = 65507;  // [octets] larger than any bundle of these tests
constexpr std::size_t kEntities = 65536;

struct Setting {
  double rate;           ///< L [1/s]
  double timeout;        ///< T [s]; 0 = none
  std::uint32_t quorum;  ///< n; 0 = none
  std::size_t payload = 1352;
};

struct Means {
  double bundle = 0.0;  ///< K
  double delay = 0.0;   ///< [s]
  double worst = 0.0;   ///< [s]
};

// Without a quorum or a large payload, 8 bare Entity States fill a bundle.
Means hybrid(const Setting& setting) {
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

Means pure_timeout(const Setting& setting) {
  const double a = setting.rate * setting.timeout;
  return {1.0 + a, setting.timeout * (1.0 + 0.5 * a) / (1.0 + a), setting.timeout};
}

Means pure_quorum(const Setting& setting) {
  const double n = setting.quorum;
  return {n, (n - 1.0) / (2.0 * setting.rate), 1e9};
}

Means closed_form(const Setting& setting) {
  if (setting.timeout == 0.0) return pure_quorum(setting);
  const bool by_size = setting.payload != kLargest;
  return setting.quorum == 0 && !by_size ? pure_timeout(setting) : hybrid(setting);
}

nanoseconds in_nanoseconds(double seconds) {
  return std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(seconds));
}

/// Emitted updates of one group, and their delays.
struct Tally {
  std::vector<nanoseconds> arrived = std::vector<nanoseconds>(kEntities);
  nanoseconds worst{0};
  double delays = 0.0;
  int left = 0, datagrams = 0;

  void count(std::span<const std::byte> datagram, nanoseconds now) {
    ++datagrams;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      if (bundled.header.pdu_type != pdu::PduType::entity_state) continue;
      const auto id = pdu::load_big_endian<std::uint16_t>(bundled.bytes.data() + 16);
      worst = std::max(worst, now - arrived[id]);
      delays += std::chrono::duration<double>(now - arrived[id]).count();
      ++left;
    }
  }
  [[nodiscard]] Means means() const {
    return {static_cast<double>(left) / datagrams, delays / left,
            std::chrono::duration<double>(worst).count()};
  }
};

/// Runs Poisson arrivals through one aggregator; group i uses policy i. The aggregator is called
/// exactly at the times that it requests. `updates` arrive in each group on average.
std::vector<Means> measured(std::span<const Setting> policies, int updates) {
  AggregatorConfig config;
  config.payload_limit = policies.front().payload;
  Aggregator aggregator(config);
  std::vector<Tally> tallies(policies.size());
  std::mt19937_64 random(20260101);
  std::vector<double> rates;
  double rate = 0.0;
  for (const Setting& policy : policies) rates.push_back(policy.rate), rate += policy.rate;
  std::exponential_distribution<double> gap(rate);
  std::discrete_distribution<std::size_t> which(rates.begin(), rates.end());
  nanoseconds now{0};
  const auto sink = [&](GroupIndex group, std::span<const std::byte> datagram) {
    tallies[group.value].count(datagram, now);
  };
  double clock = 0.0;
  for (int i = 0; i < updates * static_cast<int>(policies.size()); ++i) {
    clock += gap(random);
    const nanoseconds arrival = in_nanoseconds(clock);
    while (aggregator.next_deadline() && *aggregator.next_deadline() <= arrival) {
      now = *aggregator.next_deadline();
      aggregator.flush_due(now, sink);
    }
    now = arrival;
    const std::size_t group = which(random);
    const Setting& policy = policies[group];
    const auto id = static_cast<std::uint16_t>(i);
    tallies[group].arrived[id] = now;
    const nanoseconds deadline =
        policy.timeout == 0.0 ? nanoseconds::max() : now + in_nanoseconds(policy.timeout);
    aggregator.add(GroupIndex{static_cast<std::uint16_t>(group)}, entity_state(id), {},
                   {deadline, policy.quorum});
    aggregator.flush_due(now, sink);
  }
  std::vector<Means> means;
  for (const Tally& tally : tallies) means.push_back(tally.means());
  return means;
}

void expect_meets(const Setting& setting, const Means& actual) {
  const Means expected = closed_form(setting);
  std::printf("L %6.0f /s, T %5.1f ms, n %2u: K %.3f (closed form %.3f), delay %.4f ms (%.4f)\n",
              setting.rate, 1e3 * setting.timeout, setting.quorum, actual.bundle, expected.bundle,
              1e3 * actual.delay, 1e3 * expected.delay);
  EXPECT_NEAR(actual.bundle, expected.bundle, 0.02 * expected.bundle);
  EXPECT_NEAR(actual.delay, expected.delay, 0.02 * expected.delay);
  EXPECT_LE(actual.worst, expected.worst);
}

class AggregatorTheory : public ::testing::TestWithParam<Setting> {};

TEST_P(AggregatorTheory, MeetsClosedFormsWithinTheTimeOut) {
  expect_meets(GetParam(), measured({&GetParam(), 1}, 100000).front());
}

INSTANTIATE_TEST_SUITE_P(Hybrid, AggregatorTheory,
                         ::testing::Values(Setting{100, 0.005, 0}, Setting{500, 0.005, 0},
                                           Setting{500, 0.010, 0}, Setting{2000, 0.002, 0},
                                           Setting{2000, 0.005, 0}, Setting{10000, 0.010, 0},
                                           Setting{500, 0.010, 5}, Setting{1000, 0.003, 3},
                                           Setting{1000, 0.005, 2}, Setting{5000, 0.001, 6},
                                           Setting{300, 0.030, 7}, Setting{50, 0.030, 4}));
INSTANTIATE_TEST_SUITE_P(TimeOut, AggregatorTheory,
                         ::testing::Values(Setting{100, 0.005, 0, kLargest},
                                           Setting{1000, 0.010, 0, kLargest},
                                           Setting{5000, 0.030, 0, kLargest}));
INSTANTIATE_TEST_SUITE_P(Quorum, AggregatorTheory,
                         ::testing::Values(Setting{100, 0, 2, kLargest}, Setting{1000, 0, 8},
                                           Setting{5000, 0, 30, kLargest}));

TEST(AggregatorPolicies, HoldForEachGroupByItself) {
  const std::array<Setting, 4> policies = {{{2000, 0.004, 0, kLargest},
                                            {500, 0, 6, kLargest},
                                            {1000, 0.005, 4, kLargest},
                                            {3000, 0.001, 3, kLargest}}};
  const std::vector<Means> means = measured(policies, 100000);
  for (std::size_t i = 0; i < policies.size(); ++i) expect_meets(policies[i], means[i]);
}

TEST(AggregatorPolicies, LeastQuorumOfABundleApplies) {
  Aggregator aggregator{AggregatorConfig{}};
  Collector sent;
  const nanoseconds never = nanoseconds::max();
  aggregator.add(GroupIndex{1}, entity_state(1), {}, {never, 7});
  aggregator.add(GroupIndex{1}, entity_state(2), {}, {never, 3});
  aggregator.flush_due(seconds(100), sent);
  EXPECT_TRUE(sent.datagrams.empty()) << "two of three";
  aggregator.add(GroupIndex{1}, entity_state(2), {}, {never, 5});
  aggregator.flush_due(seconds(100), sent);
  EXPECT_TRUE(sent.datagrams.empty()) << "an update that replaces another counts once";
  aggregator.add(GroupIndex{1}, entity_state(3), {}, {never, 7});
  EXPECT_EQ(aggregator.next_deadline(), nanoseconds::min());
  aggregator.flush_due(seconds(100), sent);
  EXPECT_EQ(sent.datagrams.size(), 1u);
  EXPECT_FALSE(aggregator.next_deadline());
}

TEST(AggregatorPolicies, AnUrgentUpdateTakesAPureQuorumAlong) {
  Aggregator aggregator{AggregatorConfig{}};
  Collector sent;
  aggregator.add(GroupIndex{1}, entity_state(1), {}, {nanoseconds::max(), 8});
  aggregator.add(GroupIndex{1}, entity_state(2), {}, milliseconds(3));
  aggregator.flush_due(milliseconds(3), sent);
  ASSERT_EQ(sent.datagrams.size(), 1u);
  EXPECT_EQ(sent.datagrams[0].octets.size(), 2u * 144u + 24u);
}

/// Deadline of each entity's update, of one group.
struct Promise {
  std::vector<nanoseconds> due = std::vector<nanoseconds>(512, nanoseconds::max());
  std::size_t late = 0;
  void left(std::span<const std::byte> datagram, nanoseconds now) {
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      if (bundled.header.pdu_type != pdu::PduType::entity_state) continue;
      const auto id = pdu::load_big_endian<std::uint16_t>(bundled.bytes.data() + 16);
      late += now > due[id] ? 1 : 0;
      due[id] = nanoseconds::max();
    }
  }
};

TEST(AggregatorPolicies, NoMixOfPoliciesDelaysAnUpdate) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    Aggregator aggregator{AggregatorConfig{}};
    std::array<Promise, 3> promises;
    nanoseconds now{0};
    const auto sink = [&](GroupIndex group, std::span<const std::byte> datagram) {
      promises[group.value].left(datagram, now);
    };
    for (int i = 0; i < 4000; ++i) {
      const nanoseconds next = now + nanoseconds(random() % 400'000);
      while (aggregator.next_deadline() && *aggregator.next_deadline() <= next) {
        now = std::max(now, *aggregator.next_deadline());
        aggregator.flush_due(now, sink);
      }
      now = next;
      const GroupIndex group{static_cast<std::uint16_t>(random() % promises.size())};
      const auto id = static_cast<std::uint16_t>(random() % 512);
      const bool patient = random() % 4 == 0;
      const nanoseconds deadline =
          patient ? nanoseconds::max() : now + nanoseconds(random() % 20'000'000);
      nanoseconds& due = promises[group.value].due[id];
      due = std::min(due, deadline);
      aggregator.add(group, entity_state(id), {},
                     {deadline, static_cast<std::uint32_t>(random() % 12)});
    }
    for (const Promise& promise : promises) EXPECT_EQ(promise.late, 0u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace reckon::aoim
