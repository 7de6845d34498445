// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The traffic that others can cause: a newcomer gets all states soon; repeated joins cause at most
// one full introduction a second.
#include "reckon/aoim/presence/introduction_budget.hpp"

#include <gtest/gtest.h>

#include "reckon/tests/aoim/support/world.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

TEST(IntroductionBudget, AllowsOneAtOnceThenAtItsRate) {
  IntroductionBudget budget;
  budget.set_whole(200'000.0);
  nanoseconds now = seconds(50);
  EXPECT_TRUE(budget.may_begin(now));
  budget.spend(200'000, now);
  EXPECT_FALSE(budget.may_begin(now));
  budget.spend(100'000, now);  // rest of the running introduction
  EXPECT_FALSE(budget.may_begin(now + milliseconds(499)));
  EXPECT_TRUE(budget.may_begin(now + milliseconds(501)));
  EXPECT_TRUE(budget.may_begin(budget.ready_at()));
  EXPECT_FALSE(budget.may_begin(budget.ready_at() - milliseconds(1)));
  budget.spend(1, now + seconds(100));
  EXPECT_TRUE(budget.may_begin(now + seconds(100))) << "it holds no more than one";
  budget.spend(199'999, now + seconds(100));
  EXPECT_FALSE(budget.may_begin(now + seconds(100)));
}

TEST(IntroductionBudget, RefillRateIsLimitedForHugeOwners) {
  IntroductionBudget budget;
  budget.set_whole(20'000'000.0);
  budget.spend(20'000'000, seconds(1));
  budget.spend(std::size_t(IntroductionBudget::kMostRate), seconds(1));
  EXPECT_FALSE(budget.may_begin(milliseconds(1990)));
  EXPECT_TRUE(budget.may_begin(milliseconds(2010)));
}

struct Asking {
  std::size_t entities;
  std::int64_t every_ms;
  unsigned cells;  ///< cells joined each time; 0: new epochs announce themselves instead
};

// An owner of many entities, which answers requests.
class AskedOwner {
 protected:
  static constexpr std::size_t kOctets = 200;

  void own(std::size_t count) {
    manager_.listen(kCellTier, std::span(&kSeen, 1), now_);
    manager_.introductions().set_owned(count);
    manager_.start(now_);
    last_sent_.assign(count, nanoseconds(0));
    pass(seconds(3));
    octets_ = 0;
  }
  void pass(nanoseconds length) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += pass_) {
      manager_.step(now_, [](GroupIndex, std::span<const std::byte>) {});
      const GroupIndex group = manager_.route({});
      for (std::size_t i = 0; i < last_sent_.size(); ++i) {
        const pdu::EntityId id{7, 1, static_cast<std::uint16_t>(i + 1)};
        if (!manager_.must_send(kCellTier, id, {}, {last_sent_[i], group}, now_)) continue;
        last_sent_[i] = now_;
        octets_ += kOctets;
        manager_.introductions().note_sent(kOctets, now_);
      }
      static_cast<void>(manager_.take_events());
    }
  }
  template <typename T>
  void hears(const T& pdu, std::uint16_t port) {
    manager_.receive(kBaseGroup, encoded(pdu), now_, {{1}, port});
  }
  void joins(std::uint32_t life) {
    hears(presence_of(static_cast<std::uint16_t>(1000 + life % 5000), 5000 + life),
          static_cast<std::uint16_t>(3000 + life % 50));
  }
  void asks(std::uint32_t epoch, std::uint64_t since, unsigned cells) {
    Octets records;
    for (unsigned i = 0; i < cells; ++i)
      records = records + record_octets(pdu::CellIndex{static_cast<std::int32_t>(i), 0});
    pdu::CellMembership membership;
    membership.epoch = epoch;
    membership.action = pdu::MembershipAction::join;
    membership.since = since;
    membership.cells = records;
    hears(membership, 3000);
  }
  [[nodiscard]] bool all_sent_since(nanoseconds since) const {
    return std::ranges::all_of(last_sent_, [&](nanoseconds sent) { return sent > since; });
  }

  static constexpr Focus kSeen{{}, 0.0, 200.0};
  AreaOfInterestManager manager_{config(), presence_of(1, 11)};
  nanoseconds now_ = seconds(100), pass_ = milliseconds(1);
  std::vector<nanoseconds> last_sent_;
  std::size_t octets_ = 0;
};

class OwnerAskedOften : public AskedOwner, public testing::TestWithParam<Asking> {};
class AnOwner : public AskedOwner, public testing::Test {};

TEST_P(OwnerAskedOften, SendsAtMostOneFullIntroductionASecond) {
  const auto [entities, every_ms, cells] = GetParam();
  if (entities > 1000) pass_ = milliseconds(reckon::test::tries(4, 1));
  own(entities);
  constexpr std::int64_t kSeconds = 12;
  for (std::int64_t ms = 0; ms < 1000 * kSeconds; ms += every_ms) {
    const auto number = static_cast<std::uint32_t>(ms / every_ms);
    if (cells == 0) {
      joins(number);
    } else {
      asks(77, 1'000'000u + number, cells);
    }
    pass(milliseconds(every_ms));
  }
  const std::size_t whole = entities * kOctets;
  EXPECT_LE(octets_, std::size_t(kSeconds + 3) * whole);
  EXPECT_LE(octets_,
            static_cast<std::size_t>(kSeconds * IntroductionBudget::kMostRate) + 3 * whole);
  EXPECT_GE(octets_, std::min(std::size_t(kSeconds) * whole / 2, std::size_t(kSeconds) * 500'000u));
}

INSTANTIATE_TEST_SUITE_P(Rates, OwnerAskedOften,
                         testing::Values(Asking{500, 50, 0}, Asking{500, 7, 0},
                                         Asking{2000, 100, 0}, Asking{8000, 400, 0},
                                         Asking{500, 50, 1}, Asking{900, 11, 128}));

TEST_F(AnOwner, IntroducesAtOnceThenWithinAboutASecond) {
  own(500);
  joins(1);
  nanoseconds joined = now_;
  pass(milliseconds(220));
  EXPECT_TRUE(all_sent_since(joined));
  for (std::uint32_t life = 2; life < 12; ++life) {
    joins(life);
    pass(milliseconds(37));
  }
  joined = now_;
  joins(12);
  pass(milliseconds(1400));
  EXPECT_TRUE(all_sent_since(joined));
}

TEST_F(AnOwner, IntroducesFewEntitiesToEachNewcomerAtOnce) {
  own(5);
  for (std::uint32_t life = 0; life < 40; ++life) {
    const nanoseconds joined = now_;
    joins(life);
    pass(milliseconds(250));
    EXPECT_TRUE(all_sent_since(joined)) << life;
  }
}

// A long-known peer is served despite the joins of strangers.
TEST_F(AnOwner, IntroducesKnownPeersDuringJoinFlood) {
  own(500);
  pdu::Presence member = presence_of(600, 4711);
  hears(member, 3000);
  for (int second = 0; second < 12; ++second) {
    pass(seconds(1));
    hears(member, 3000);
  }
  for (std::uint32_t life = 0; life < 60; ++life) {
    joins(life);
    pass(milliseconds(10));
  }
  const nanoseconds asked = now_;
  asks(4711, 99, 1);
  for (std::uint32_t life = 60; life < 80; ++life) {
    joins(life);
    pass(milliseconds(10));
  }
  EXPECT_TRUE(all_sent_since(asked));
}

}  // namespace
}  // namespace reckon::aoim
