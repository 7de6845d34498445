// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/condition_effect.hpp"

#include <gtest/gtest.h>

#include <random>

namespace reckon::haptics {
namespace {

const EffectScale kScale{0.2, 20.0, 2000.0};

TEST(ConditionEffect, LowerWallHasOnlyALeftCoefficient) {
  const ff_condition_effect told = condition_of({0.05, 1000.0, 10.0}, WallSide::below, kScale);
  EXPECT_EQ(told.center, 16383);  // half of 0x7FFF, rounded away from the handle
  EXPECT_EQ(told.left_coeff, 16383);
  EXPECT_EQ(told.right_coeff, 0);
  EXPECT_EQ(told.left_saturation, 32767);
  EXPECT_EQ(told.right_saturation, 0);
  EXPECT_EQ(told.deadband, 0);
}

TEST(ConditionEffect, UpperWallIsItsMirror) {
  const ff_condition_effect told = condition_of({-0.05, 1000.0, 10.0}, WallSide::above, kScale);
  EXPECT_EQ(told.center, -16383);
  EXPECT_EQ(told.right_coeff, 16383);
  EXPECT_EQ(told.left_coeff, 0);
  EXPECT_EQ(told.right_saturation, 32767);
}

TEST(ConditionEffect, ExcessStiffnessIsTheDevicesMaximum) {
  const ff_condition_effect told = condition_of({0.0, 1e6, 1e6}, WallSide::above, kScale);
  EXPECT_EQ(told.right_coeff, 0x7FFF);
  EXPECT_EQ(told.right_saturation, 0xFFFF);
}

TEST(ConditionEffect, WallBeyondTheAxisIsEmpty) {
  for (const double at : {-0.11, 0.11, 1e30}) {
    const ff_condition_effect told = condition_of({at, 1000.0, 10.0}, WallSide::below, kScale);
    EXPECT_EQ(told.left_coeff, 0) << at;
    EXPECT_EQ(told.left_saturation, 0) << at;
  }
}

TEST(ConditionEffect, UploadedConditionNeverStoresMoreThanTheWall) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-0.1, 0.1), k(1.0, 2500.0), most(0.0, 25.0);
  double furthest = 0;
  for (int i = 0; i < 20'000; ++i) {
    const SpringWall wall{at(random), k(random), most(random)};
    const WallSide side = i % 2 == 0 ? WallSide::below : WallSide::above;
    const SpringWall told = as_told(wall, side, kScale);
    const double x = at(random);
    EXPECT_LE(stored_in(told, side, x), stored_in(wall, side, x) + 1e-15);
    if (told.stiffness > 0) furthest = std::max(furthest, std::abs(told.at - wall.at));
  }
  EXPECT_LE(furthest, 0.1 / 32767 * 1.001);  // one step
}

TEST(ConditionEffect, ReadingIsAPositionFromTheMiddle) {
  const EventAxis axis{0, 1000};
  EXPECT_DOUBLE_EQ(place_of(0, axis, kScale), -0.1);
  EXPECT_DOUBLE_EQ(place_of(500, axis, kScale), 0.0);
  EXPECT_DOUBLE_EQ(place_of(1000, axis, kScale), 0.1);
  EXPECT_DOUBLE_EQ(step_of(axis, kScale), 0.0002);
  EXPECT_DOUBLE_EQ(place_of(0, {-2147483647, 2147483647}, kScale), 0.0);
}

TEST(ConditionEffect, EffectHasBothAxesItsIdAndLength) {
  SpringModel model;
  model.wall(0, WallSide::above) = {0.05, 500.0, 5.0};
  model.wall(1, WallSide::above) = {-0.05, 1000.0, 5.0};
  model.wall(1, WallSide::below) = {0.0, 2000.0, 5.0};
  const ff_effect effect = effect_of(model, WallSide::above, kScale, 3, 60);
  EXPECT_EQ(effect.type, FF_SPRING);
  EXPECT_EQ(effect.id, 3);
  EXPECT_EQ(effect.replay.length, 60);
  EXPECT_EQ(effect.replay.delay, 0);
  EXPECT_EQ(effect.u.condition[0].right_coeff, 8191);
  EXPECT_EQ(effect.u.condition[1].right_coeff, 16383);
  EXPECT_EQ(effect.u.condition[1].left_coeff, 0);
}

}  // namespace
}  // namespace reckon::haptics
