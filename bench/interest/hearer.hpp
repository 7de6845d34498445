// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An entity of IncrementalInterest: its position, its radius of reception, and how it is compared.
#pragma once

#include <cstdint>
#include <limits>

#include "reckon/aoim/cells/position.hpp"

namespace reckon::bench {

/// The position of an entity and its radius of reception.
struct Hearer {
  static constexpr double kNobody = -1.0;  ///< receives nobody: no square is below 0

  aoim::Position position{std::numeric_limits<double>::quiet_NaN(), 0, 0};
  double squared_radius = kNobody;  ///< [m^2]

  /// Whether it receives an entity at this squared distance; false if that is NaN.
  [[nodiscard]] bool hears(double squared) const noexcept { return squared <= squared_radius; }
};

[[nodiscard]] inline double squared_distance(const aoim::Position& a,
                                             const aoim::Position& b) noexcept {
  const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
  return dx * dx + dy * dy + dz * dz;
}

/// Whether an entity is left out of the comparison by runs, and the reason.
enum class Apart : std::uint8_t { no, leapt, far };

}  // namespace reckon::bench
