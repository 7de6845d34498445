// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of motions made by formulas, for studies: the truth and all its rates are known in
// closed form. A new one is a function in motions.cpp and a row there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/bench/studies/tracks/track.hpp"

namespace reckon::bench {

/// Samples of every motion [1/s]: those of a display.
inline constexpr double kMotionRate = 60;

struct Motion {
  std::string_view name;
  std::string_view meaning;
  /// Thresholds that suit its size [m], growing.
  std::array<double, 6> thresholds;
  /// The motion over `seconds` > 0, reference axes x, y level and z up, body axes x forward, y
  /// right, z down. Equal arguments give equal samples.
  Track (*generate)(double seconds, std::uint64_t seed);
};

[[nodiscard]] std::span<const Motion> motions();

}  // namespace reckon::bench
