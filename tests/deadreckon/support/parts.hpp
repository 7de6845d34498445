// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Articulated parts for the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "reckon/deadreckon/motion/articulation.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::array<PartMetric, 8> kMetrics = {
    PartMetric::position, PartMetric::extension, PartMetric::x,         PartMetric::y,
    PartMetric::z,        PartMetric::azimuth,   PartMetric::elevation, PartMetric::rotation};

// SISO UID 59.
inline constexpr std::uint32_t kTurret = 128, kGun = 138, kLandingGear = 96;

inline PartParameter parameter(std::uint32_t part, PartMetric metric, double value,
                               double rate = 0) {
  PartParameter p;
  p.part = part;
  p.metric = metric;
  p.value = value;
  p.rate = rate;
  return p;
}

inline PartState one(const PartParameter& p) {
  PartState state;
  EXPECT_TRUE(state.set(p));
  return state;
}

inline PartState random_state(Random& random) {
  PartState state;
  const auto parts = static_cast<std::size_t>(random.real(0, 33));
  for (std::size_t i = 0; i < parts; ++i) {
    PartParameter p = parameter(kTurret + static_cast<std::uint32_t>(i / 8), kMetrics[i % 8],
                                random.real(-3, 3), random.real(-2, 2));
    p.attached_to = static_cast<std::uint16_t>(random.real(0, 4));
    EXPECT_TRUE(state.set(p));
  }
  return state;
}

}  // namespace reckon::deadreckon::test
