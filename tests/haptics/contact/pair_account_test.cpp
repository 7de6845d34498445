// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/pair_account.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {
namespace {

constexpr pdu::EntityId kWhose{1, 1, 1};

PairAccount opened(double total) {
  PairAccount account;
  account.open(kWhose, 7, total);
  return account;
}

TEST(PairAccount, CreditsNothingGivenBeforeTheFirstReport) {
  EnergyPort port(1.0);
  PairAccount account = opened(0.5);
  account.claim(port);
  EXPECT_EQ(account.received, 0.0);
  account.receive(7, 0.502);
  account.claim(port);
  EXPECT_NEAR(account.received, 0.002, 1e-12);
  EXPECT_NEAR(port.level(), 0.002, 1e-12);
  account.receive(7, 0.501);  // stale
  account.claim(port);
  EXPECT_NEAR(account.received, 0.002, 1e-12);
}

TEST(PairAccount, ContinuesForReturningAndRestartsForOtherHand) {
  EnergyPort port(1.0);
  PairAccount account = opened(0.0);
  account.receive(7, 0.002);
  account.claim(port);
  account.open(kWhose, 7, 0.0);
  EXPECT_NEAR(account.seen, 0.002, 1e-12);
  account.open({1, 1, 2}, 3, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(account.seen, 0.0);
  EXPECT_EQ(account.received, 0.0);
}

TEST(PairAccount, IgnoresEarlierTotalsOfANewEpoch) {
  EnergyPort port(1.0);
  PairAccount account = opened(0.0);
  account.receive(8, 0.004);
  account.claim(port);
  EXPECT_EQ(account.received, 0.0);
  account.receive(8, -1.0);
  account.receive(8, std::numeric_limits<double>::infinity());
  account.claim(port);
  EXPECT_EQ(account.received, 0.0);
}

TEST(PairAccount, LimitsObservedEnergyToATenthJoule) {
  PairAccount account = opened(0.0);
  account.see(0.03);
  EXPECT_NEAR(account.believed, 0.03, 1e-12);
  account.see(10.0);
  EXPECT_NEAR(account.believed, 0.1, 1e-12);
  account.see(-10.0);
  EXPECT_NEAR(account.believed, -0.1, 1e-12);
}

TEST(PairAccount, CountsTheEnergyReleasedByThePort) {
  EnergyPort port(1.0);
  PairAccount account = opened(0.0);
  EXPECT_EQ(account.give(port, 0.01), 0.0) << "there is nothing";
  EXPECT_NEAR(port.credit(0.01), 0.01, 1e-12);
  EXPECT_NEAR(account.give(port, 0.004), 0.004, 1e-12);
  EXPECT_NEAR(account.given, 0.004, 1e-12);
  EXPECT_NEAR(account.believed, 0.004, 1e-12);
  EXPECT_NEAR(port.level(), 0.006, 1e-12);
}

}  // namespace
}  // namespace reckon::haptics
