// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/blow.hpp"

#include <gtest/gtest.h>

namespace reckon::haptics {
namespace {

constexpr double kDt = 0.001;  // [s]

Blow late_blow() {
  Blow blow;
  blow.expect(0.5, 0.1);
  return blow;
}

void wait(Blow& blow, double seconds) {
  for (int i = 0; i < seconds / kDt; ++i) blow.pass(kDt);
}

TEST(Blow, LastsHalfASecondAfterAQuickApproach) {
  Blow blow;
  blow.see(0.1, 0.1);
  EXPECT_FALSE(blow.is_on()) << "a press";
  blow.see(0.2, 0.0);
  wait(blow, 0.4);
  EXPECT_TRUE(blow.is_on());
  blow.see(0.2, 0.0);
  wait(blow, 0.4);
  EXPECT_TRUE(blow.is_on());
  wait(blow, 0.2);
  EXPECT_FALSE(blow.is_on());
}

TEST(Blow, DelaysTheHandAndReturnsSlowlyInContact) {
  Blow blow = late_blow();
  const double behind = blow.behind();
  EXPECT_GT(behind, 0.1);
  EXPECT_EQ(blow.move_on(kDt, true), kDt);
  EXPECT_EQ(blow.behind(), behind);
  wait(blow, 1.0);
  EXPECT_NEAR(blow.move_on(kDt, true), 1.5 * kDt, 1e-12);
  EXPECT_NEAR(blow.move_on(kDt, false), 2.0 * kDt, 1e-12);
  EXPECT_NEAR(blow.behind(), behind - 1.5 * kDt, 1e-12);
  for (int i = 0; i < 1000; ++i) static_cast<void>(blow.move_on(kDt, false));
  EXPECT_EQ(blow.behind(), 0.0);
  EXPECT_EQ(blow.move_on(kDt, false), kDt);
}

TEST(Blow, IsPredictedBeyondItsOwnersLastUpdateOnly) {
  const Blow blow = late_blow();
  EXPECT_FALSE(blow.is_guessed(0.9 * blow.behind()));
  EXPECT_TRUE(blow.is_guessed(1.1 * blow.behind()));
  EXPECT_FALSE(Blow().is_guessed(1.0));
  EXPECT_NEAR(Blow::deepest_guess(0.002, 0.5, 500.0), 0.002 + 0.5 * 0.01, 1e-12);
  EXPECT_EQ(Blow::deepest_guess(0.002, 0.0, 0.0), 0.002);
}

TEST(Blow, ReleasesWithNewDataUnlikeAPress) {
  EXPECT_EQ(Blow().release(kDt), 0.0);
  EXPECT_NEAR(late_blow().release(kDt), 1.0 / 3.0, 1e-12);
  EXPECT_EQ(late_blow().release(1.0), 1.0);
}

TEST(Blow, GivesEnergyPartlyAtOnceThenGradually) {
  Blow blow;
  blow.see(0.3, 0.2);
  EXPECT_EQ(blow.gift(0.001, 1.0, kDt), 0.0) << "near by, who is struck asks in time";
  EXPECT_NEAR(blow.gift(0.02, 1.0, kDt), 0.005, 1e-12);
  double more = 0.0;
  for (int i = 0; i < 1000; ++i) more += blow.gift(0.02, 1.0, kDt);
  EXPECT_NEAR(more, 0.01, 1e-12);
}

TEST(Blow, GivesAtMostHalfOfTheSpareEnergy) {
  Blow blow;
  blow.see(0.3, 0.2);
  EXPECT_EQ(blow.gift(0.02, 0.002, kDt), 0.001);
  EXPECT_EQ(blow.gift(0.02, -1.0, kDt), 0.0);
  Blow struck;
  struck.see(0.3, 0.0);
  EXPECT_EQ(struck.gift(0.02, 1.0, kDt), 0.0);
}

}  // namespace
}  // namespace reckon::haptics
