// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The wheel of the virtual machine, driven with the octets of its descriptor.
#include "reckon/tests/haptics/support/pid_wheel.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

namespace reckon::test {
namespace {

using std::chrono::milliseconds;
using Octets = std::vector<std::uint8_t>;

constexpr std::uint8_t kEffect = 1;

Octets with_words(Octets report, std::initializer_list<int> words) {
  for (const int word : words) {
    report.push_back(static_cast<std::uint8_t>(word));
    report.push_back(static_cast<std::uint8_t>(word >> 8));
  }
  return report;
}

class PidWheelTold : public ::testing::Test {
 protected:
  // A wall below -12.5 mm, of 800 N/m and at most 7.5 N, for 60 ms from each start.
  void SetUp() override {
    wheel_.run_until(milliseconds(1));
    wheel_.take(Octets{6, 1});             // actuators on
    wheel_.take(with_words({9, 1}, {0}));  // a new spring
    ASSERT_EQ(wheel_.feature(10), (Octets{10, kEffect, 1, 0xE8, 3}));
    Octets effect = with_words({3, kEffect, 1}, {60, 0, 0, 0});
    effect.insert(effect.end(), {255, 1, 4, 0, 0, 0, 0});
    wheel_.take(effect);
    wheel_.take(with_words({8, kEffect, 0}, {-1000, 0, 4000, 0, 5000, 0}));
  }
  void start() { wheel_.take(Octets{4, kEffect, 1, 1}); }
  void press(double place) {
    wheel_.want(0, place);
    for (int i = 0; i < 200; ++i) {
      start();
      wheel_.run_until(now_ += milliseconds(10));
    }
  }

  PidWheel wheel_{{}};
  std::chrono::nanoseconds now_ = milliseconds(1);
};

TEST_F(PidWheelTold, SpringPressesByDepthUpToItsMaximum) {
  press(-0.0125 - 0.011);  // 11 mm deep; a hand of 300 N/m presses 3 mm
  EXPECT_NEAR(wheel_.place(0), -0.0125 - 0.003, 1e-6);
  EXPECT_NEAR(wheel_.force(0), 800 * 0.003, 1e-3);
  press(-0.1);
  EXPECT_NEAR(wheel_.force(0), 7.5, 1e-9);
  // The hand has put in the energy of the spring: its triangle, and the part beyond saturation.
  const double depth = -0.0125 - wheel_.place(0), knee = 7.5 / 800;
  EXPECT_NEAR(wheel_.absorbed(), 7.5 * knee / 2 + 7.5 * (depth - knee), 1e-9);
  press(0.02);
  EXPECT_EQ(wheel_.force(0), 0);
  EXPECT_NEAR(wheel_.absorbed(), 0, 1e-12);
  EXPECT_EQ(wheel_.strange(), 0);
}

TEST_F(PidWheelTold, EffectEndsByTimeAndByEachOrder) {
  press(-0.03);
  wheel_.run_until(now_ += milliseconds(49));
  EXPECT_GT(wheel_.force(0), 1);
  wheel_.run_until(now_ += milliseconds(2));
  EXPECT_EQ(wheel_.playing(), 0U);
  const Octets orders[] = {{4, kEffect, 3, 0}, {6, 2}, {6, 3}, {6, 4}, {5, kEffect}};
  for (const Octets& order : orders) {
    wheel_.lose_power();
    PidWheelTold::SetUp();
    start();
    EXPECT_GT(wheel_.force(0), 1);
    wheel_.take(order);
    EXPECT_EQ(wheel_.force(0), 0) << int{order[0]} << ' ' << int{order[1]};
  }
}

TEST_F(PidWheelTold, CountsUnknownOrders) {
  wheel_.take(Octets{4, 7, 1, 1});  // there is no effect 7
  wheel_.take(Octets{8, kEffect});  // truncated
  wheel_.take(Octets{99, 0});
  EXPECT_EQ(wheel_.strange(), 3);
  EXPECT_EQ(wheel_.feature(8), std::nullopt);
}

}  // namespace
}  // namespace reckon::test
