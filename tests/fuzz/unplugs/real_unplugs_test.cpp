// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Some unplugs in real time; `unplugs_in_real_time` makes more. A busy host may miss 10 ms, so no
// time is asserted.
#include "reckon/tests/fuzz/unplugs/real_unplugs.hpp"

#include <gtest/gtest.h>

#include "reckon/tests/fuzz/unplugs/counted_usb.hpp"

namespace reckon::fuzz::unplugs {
namespace {

constexpr unsigned kRounds = 8;

void expect_all(const RealOutcome& outcome) {
  EXPECT_EQ(outcome.problem, "");
  EXPECT_EQ(outcome.rounds, kRounds);
  EXPECT_TRUE(is_usb_given_back());
}

TEST(RealUnplugs, OfAFalconWithARunningThread) {
  expect_all(unplug_usb(DeviceKind::falcon, kRounds, 1));
}

TEST(RealUnplugs, OfAPolhemWithARunningThread) {
  expect_all(unplug_usb(DeviceKind::polhem, kRounds, 2));
}

TEST(RealUnplugs, OfASerialBoardBehindATty) { expect_all(unplug_board(kRounds, 3)); }

}  // namespace
}  // namespace reckon::fuzz::unplugs
