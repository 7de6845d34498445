// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/roll.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "reckon/peer/ownership/act_book.hpp"
#include "reckon/peer/ownership/lease_book.hpp"

namespace reckon::peer {
namespace roll_test {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

Roll roll_of(std::initializer_list<std::uint8_t> hosts) {
  Roll roll;
  std::uint32_t epoch = 1;
  for (const std::uint8_t host : hosts) roll.add({epoch++, host});
  return roll;
}

// Voter i votes if bit i is set.
bool is_majority(const Roll& roll, std::uint32_t bits) {
  return roll.is_majority([&](const Voter& voter) { return (bits >> (voter.epoch - 1) & 1) != 0; });
}

TEST(Roll, GivesATieToTheSenior) {
  const Roll two = roll_of({0, 1});
  EXPECT_TRUE(is_majority(two, 0b01));
  EXPECT_FALSE(is_majority(two, 0b10));
  const Roll three = roll_of({0, 1, 2});
  EXPECT_FALSE(is_majority(three, 0b001));
  EXPECT_TRUE(is_majority(three, 0b110));
}

TEST(Roll, GivesPeersOfAHostOneVote) {
  const Roll local = roll_of({0, 0, 0});
  EXPECT_FALSE(is_majority(local, 0b001));
  EXPECT_TRUE(is_majority(local, 0b110));
  // Three peers of one host have no more votes than the one of another.
  const Roll uneven = roll_of({1, 0, 0, 0});
  EXPECT_TRUE(is_majority(uneven, 0b0001));
  EXPECT_FALSE(is_majority(uneven, 0b1110));
  EXPECT_TRUE(is_majority(uneven, 0b0011));
}

TEST(Roll, HasNoTwoMajoritiesApart) {
  for (const Roll& roll : {roll_of({0, 1}), roll_of({0, 0, 1}), roll_of({0, 1, 1, 2}),
                           roll_of({0, 0, 1, 1, 2, 2}), roll_of({0, 0, 0, 1, 1, 2, 3})}) {
    const std::uint32_t all = (1U << roll.size()) - 1;
    for (std::uint32_t bits = 0; bits <= all; ++bits)
      ASSERT_FALSE(is_majority(roll, bits) && is_majority(roll, all & ~bits)) << bits;
  }
}

TEST(LeaseBook, BeginsALeaseWhenTheRoundWasSent) {
  LeaseBook leases;
  const Roll roll = roll_of({1, 0});  // the peer with epoch 2 asks
  const std::uint8_t round = leases.round(seconds(10));
  leases.confirm(1, round, seconds(11));  // a second later
  EXPECT_EQ(leases.lease_end(roll, 2, seconds(11)), seconds(10) + LeaseBook::kLease);
}

TEST(LeaseBook, TakesNoOldRoundForANewOne) {
  LeaseBook leases;
  const Roll roll = roll_of({1, 0});
  const std::uint8_t old = leases.round(seconds(10));
  nanoseconds now = seconds(10);
  for (int i = 0; i < 254; ++i) static_cast<void>(leases.round(now += LeaseBook::kRound));
  leases.confirm(1, old, now);
  EXPECT_LT(leases.lease_end(roll, 2, now), now);
}

TEST(LeaseBook, CountsSilenceFromTheLastNewRound) {
  LeaseBook leases;
  leases.receive(5, 10, seconds(1));
  leases.receive(5, 9, seconds(2));  // late
  EXPECT_EQ(leases.silent_since(5), seconds(1));
  leases.receive(5, 11, seconds(3));
  EXPECT_EQ(leases.silent_since(5), seconds(3));
  leases.restart(seconds(7));
  EXPECT_EQ(leases.silent_since(5), seconds(7));
}

TEST(ActBook, RefusesLowerBallotsThanItPromised) {
  ActBook acts;
  Act first;
  first.number = 1;
  first.chair = 1;
  ASSERT_TRUE(acts.decide(first));
  Act next = first, later = first;
  next.number = 2;
  later.number = 3;
  ASSERT_TRUE(acts.may_accept(next, {1, 1}));
  acts.promise({2, 3});
  EXPECT_FALSE(acts.may_accept(next, {1, 9}));
  EXPECT_TRUE(acts.may_accept(next, {2, 3}));
  EXPECT_FALSE(acts.may_accept(later, {5, 1}));
  acts.accept(next, {2, 3});
  EXPECT_EQ(acts.newest().number, 2U);
  EXPECT_EQ(acts.decided().number, 1U);
  ASSERT_TRUE(acts.decide(next));
  EXPECT_EQ(acts.pending(), nullptr);
  EXPECT_FALSE(acts.decide(first)) << "an older one";
}

}  // namespace roll_test
}  // namespace reckon::peer
