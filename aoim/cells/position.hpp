// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Points of the scene frame S (east-north-up tangent frame, metres), without a matrix library.
#pragma once

#include <cmath>

namespace reckon::aoim {

/// A point in S [m].
struct Position {
  double x = 0.0, y = 0.0, z = 0.0;
  bool operator==(const Position&) const = default;
};

/// Distance of two points [m]; NaN or infinite if an input is.
[[nodiscard]] inline double distance(const Position& a, const Position& b) noexcept {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

/// False for NaN and infinity in any axis.
[[nodiscard]] inline bool is_finite(const Position& p) noexcept {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

}  // namespace reckon::aoim
