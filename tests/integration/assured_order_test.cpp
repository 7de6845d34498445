// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Assured interactions in the order of their sender, over simulated networks that lose, delay and
// reorder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>
#include <vector>

#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/tests/integration/federates.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using peer::Delivery;
using peer::Federate;
using peer::Order;
using std::chrono::nanoseconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Federates that note the numbers of the shots of each other, in the order in which they take
/// them.
class OrderedFederates {
 public:
  /// Numbers taken, by the application number of their sender.
  using Taken = std::map<std::uint16_t, std::vector<std::uint32_t>>;

  OrderedFederates(std::size_t most, const peer::ImpairmentLaw& law, std::uint64_t seed = 1)
      : federates_(most, law, seed), ordered_(most), others_(most) {}

  /// The next federate begins to join.
  void join() {
    const std::size_t i = federates_.size();
    Federate& federate = federates_.join(open_country());
    federate.publish<pdu::Fire>();
    federate.subscribe<pdu::Fire>([this, i](const pdu::Fire& fire) {
      Taken& taken = fire.fire_mission_index < kOthers ? ordered_[i] : others_[i];
      taken[fire.firing_entity_id.application].push_back(fire.fire_mission_index);
    });
    federate.on_undelivered([this](const peer::UndeliveredMessage&) { ++undelivered; });
  }
  void send(std::size_t sender, std::uint32_t number, Order order = Order::per_source) {
    pdu::Fire fire;
    fire.firing_entity_id = {1, static_cast<std::uint16_t>(sender + 1), 900};
    fire.fire_mission_index = order == Order::none ? kOthers + number : number;
    federates_[sender].send(fire, Delivery::assured, order);
  }
  /// Sets the law of all lines.
  void impair(const peer::ImpairmentLaw& law) { federates_.impair(law); }
  /// Runs until all have joined.
  void wait_for_joins() {
    const auto know_all = [this] {
      for (std::size_t i = 0; i < federates_.size(); ++i) {
        federates_[i].peer().views().update();
        if (federates_[i].peer().views().read().peers + 1 < federates_.size()) return false;
      }
      return true;
    };
    for (int i = 0; i < 1000 && !know_all(); ++i) run(5ms);
    ASSERT_TRUE(know_all());
  }
  void run(nanoseconds span) {
    federates_.run(
        span, 500us, [] {}, [] {});
  }
  [[nodiscard]] Federates& all() { return federates_; }
  /// Numbers that a federate took of the interactions with an order.
  [[nodiscard]] std::vector<std::uint32_t>& taken(std::size_t at, std::size_t of) {
    return ordered_[at][static_cast<std::uint16_t>(of + 1)];
  }
  [[nodiscard]] std::vector<std::uint32_t>& others(std::size_t at, std::size_t of) {
    return others_[at][static_cast<std::uint16_t>(of + 1)];
  }

  std::size_t undelivered = 0;

 private:
  static constexpr std::uint32_t kOthers = 1'000'000;

  Federates federates_;
  std::vector<Taken> ordered_, others_;
};

peer::ImpairmentLaw line(double loss) {
  peer::ImpairmentLaw law = Federates::delayed(2ms, loss, 4ms);
  law.duplicate = 0.1;
  return law;
}

/// The numbers of `begin` to `end`.
std::vector<std::uint32_t> numbers(std::uint32_t begin, std::uint32_t end) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = begin; i < end; ++i) out.push_back(i);
  return out;
}

class OrderAtLoss : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Share, OrderAtLoss, testing::Values(0.0, 0.2, 0.4));

TEST_P(OrderAtLoss, EachSourceIsTakenInOrder) {
  constexpr std::uint32_t kCount = 150;
  for (int seed = 1; seed <= tries(2, 500); ++seed) {
    OrderedFederates peers(4, line(0.0), static_cast<std::uint64_t>(seed));
    for (int i = 0; i < 4; ++i) peers.join();
    peers.wait_for_joins();
    peers.impair(line(GetParam()));
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    for (std::uint32_t i = 0; i < kCount; ++i) {
      for (std::size_t sender = 0; sender < 3; ++sender) {
        peers.send(sender, i);
        if (random() % 3 == 0) peers.send(sender, i, Order::none);
      }
      if (random() % 2 == 0) peers.run(1ms * (random() % 8));
    }
    peers.run(4s);
    for (std::size_t at = 0; at < 4; ++at) {
      for (std::size_t of = 0; of < 3; ++of) {
        if (at == of) continue;
        ASSERT_EQ(peers.taken(at, of), numbers(0, kCount)) << "seed " << seed;
        std::vector<std::uint32_t>& others = peers.others(at, of);
        ASSERT_EQ(others.size(), peers.others(at == 3 ? (of + 1) % 3 : 3, of).size());
        std::ranges::sort(others);
        ASSERT_EQ(std::ranges::adjacent_find(others), others.end()) << "none twice";
      }
    }
    EXPECT_EQ(peers.undelivered, 0u) << "seed " << seed;
    EXPECT_EQ(peers.all().count(3, "assured_held_in") > 0, true) << "the line reorders";
  }
}

// A newcomer takes all records from its join on, in order, although older ones for another peer are
// still repeated.
TEST(AssuredOrder, NewcomerStartsAtItsJoin) {
  for (int seed = 1; seed <= tries(5, 500); ++seed) {
    OrderedFederates peers(3, line(0.0), static_cast<std::uint64_t>(seed));
    peers.join();
    peers.join();
    peers.wait_for_joins();
    peers.impair(line(0.1));
    // The second one gets nothing for a while, so that old interactions are under way.
    peers.all().impair(0, 1, Federates::delayed(2ms, 1.0));
    std::uint32_t sent = 0;
    const auto send = [&](std::uint32_t count) {
      for (const std::uint32_t end = sent + count; sent < end; ++sent) {
        peers.send(0, sent);
        peers.run(5ms);
      }
    };
    send(80);
    peers.join();
    send(20);
    peers.wait_for_joins();
    const std::uint32_t first = sent;
    send(60);
    peers.run(1s);
    EXPECT_GT(peers.taken(2, 0).size(), 50u) << "it does not wait for the second one, " << seed;
    peers.impair(line(0.1));
    peers.run(3s);
    std::vector<std::uint32_t>& taken = peers.taken(2, 0);
    EXPECT_TRUE(std::ranges::is_sorted(taken)) << "seed " << seed;
    const auto begin = std::ranges::lower_bound(taken, first);
    EXPECT_EQ(std::vector(begin, taken.end()), numbers(first, sent)) << "seed " << seed;
    EXPECT_EQ(peers.taken(1, 0), numbers(0, sent)) << "seed " << seed;
  }
}

TEST(AssuredOrder, LossDelaysOnlyItsSource) {
  OrderedFederates peers(3, Federates::delayed(1ms));
  for (int i = 0; i < 3; ++i) peers.join();
  peers.run(1500ms);
  peers.all().impair(0, 2, Federates::delayed(1ms, 1.0));
  peers.send(0, 0);
  peers.run(50ms);
  peers.all().impair(0, 2, Federates::delayed(1ms));
  peers.send(0, 1);
  peers.send(0, 0, Order::none);
  peers.send(1, 0);
  peers.run(4ms);
  EXPECT_THAT(peers.taken(1, 0), ElementsAre(0, 1));
  EXPECT_THAT(peers.taken(2, 0), IsEmpty()) << "the first is repeated 96 ms after it was sent";
  EXPECT_THAT(peers.others(2, 0), SizeIs(1));
  EXPECT_THAT(peers.taken(2, 1), ElementsAre(0));
  peers.run(50ms);
  EXPECT_THAT(peers.taken(2, 0), ElementsAre(0, 1));
}

TEST(AssuredOrder, ContinuesAfterAFailedInteraction) {
  OrderedFederates peers(2, Federates::delayed(1ms));
  peers.join();
  peers.join();
  peers.run(1500ms);
  peers.all().impair(0, 1, Federates::delayed(1ms, 1.0));
  peers.send(0, 0);
  peers.run(2s);
  peers.send(0, 1);
  peers.run(2900ms);
  peers.all().impair(0, 1, Federates::delayed(1ms));
  peers.send(0, 2);
  peers.run(5ms);
  EXPECT_THAT(peers.taken(1, 0), IsEmpty());
  peers.run(1s);
  const std::vector<std::uint32_t>& taken = peers.taken(1, 0);
  EXPECT_TRUE(taken == numbers(0, 3) || taken == numbers(1, 3)) << taken.size();
  EXPECT_EQ(peers.undelivered, 3 - taken.size());
}

TEST(AssuredOrder, RefusesBestEffort) {
  OrderedFederates peers(1, {});
  peers.join();
  EXPECT_THROW(peers.all()[0].send(pdu::Fire{}, Delivery::best_effort, Order::per_source),
               std::logic_error);
}

}  // namespace
}  // namespace reckon::test
