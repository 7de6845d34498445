// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of motions with closed formulas, for studies: position and all derivatives are exact. To
// add one, write a function in motions.cpp and a row in its list.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/bench/studies/tracks/track.hpp"

namespace reckon::bench {

/// Sample rate of every motion [1/s], equal to that of a display.
inline constexpr double kMotionRate = 60;

struct Motion {
  std::string_view name;
  std::string_view meaning;
  /// Thresholds that suit the size of the motion [m], ascending.
  std::array<double, 6> thresholds;
  /// The motion over `seconds` > 0, reference axes x, y level and z up, body axes x forward, y
  /// right, z down. Equal arguments give equal samples.
  Track (*generate)(double seconds, std::uint64_t seed);
};

[[nodiscard]] std::span<const Motion> motions();

}  // namespace reckon::bench
