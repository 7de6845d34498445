// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An entity of IncrementalInterest: where it is, what it hears, and how it is compared.
#pragma once

#include <cstdint>
#include <limits>

#include "reckon/aoim/cells/position.hpp"

namespace reckon::bench {

/// Where an entity is, and up to where it hears.
struct Hearer {
  static constexpr double kNobody = -1.0;  ///< no square is below 0

  aoim::Position position{std::numeric_limits<double>::quiet_NaN(), 0, 0};
  double squared_radius = kNobody;  ///< [m^2]

  /// Whether it hears who is at this squared distance; nobody where that is NaN.
  [[nodiscard]] bool hears(double squared) const noexcept { return squared <= squared_radius; }
};

[[nodiscard]] inline double squared_distance(const aoim::Position& a,
                                             const aoim::Position& b) noexcept {
  const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
  return dx * dx + dy * dy + dz * dz;
}

/// Whether an entity is left out where slots are compared by runs, and why.
enum class Apart : std::uint8_t { no, leapt, far };

}  // namespace reckon::bench
