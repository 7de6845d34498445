// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/split.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kMostOfSpare = 0.999;  // of c0 that springs may use: the rest pays for held forces
constexpr int kHalvings = 40;

// Greatest weight that leaves both energy and damping.
template <int axes>
double greatest_weight(const SplitBoundOf<axes>& bound) noexcept {
  double most = 1.0;
  if (bound.stored > bound.energy) most = bound.energy / bound.stored;
  if (bound.half_slope > 0) most = std::min(most, kMostOfSpare * bound.spare / bound.half_slope);
  return most;
}

}  // namespace

// The cost is convex in w: a square over a line, plus a line. Multiplied out it is a quadratic
//   Q(w) = rests(w) - 4 (c0 - w k) (E - w S) <= 0
// that is >= 0 at the greatest w with both factors positive. So the allowed weights are an
// interval. It begins at 0, at the vertex or nowhere, and its end is found by bisection.
template <int axes>
std::optional<double> largest_weight(const SplitBoundOf<axes>& bound,
                                     const typename SplitBoundOf<axes>::Force& wanted) noexcept {
  if (!(bound.spare > 0) || !(bound.energy >= 0)) return std::nullopt;
  const double most = greatest_weight(bound);
  const AxisForces<axes>& springs = bound.springs;
  const auto cost = [&](double w) {
    return bound.rests(wanted, w) -
           4.0 * (bound.spare - w * bound.half_slope) * (bound.energy - w * bound.stored);
  };
  if (most >= 1.0 && cost(1.0) <= 0) return 1.0;

  double low = 0.0;
  if (cost(0.0) > 0) {
    const double square = (1.0 + bound.under_way.count) * springs.squaredNorm() -
                          4.0 * bound.half_slope * bound.stored;
    const double line = 4.0 * (bound.spare * bound.stored + bound.half_slope * bound.energy) -
                        2.0 * (wanted + bound.under_way.sum).dot(springs);
    if (!(square > 0)) return std::nullopt;
    low = -0.5 * line / square;
    if (!(low > 0 && low < most) || cost(low) > 0) return std::nullopt;
  }
  double high = most;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (cost(middle) <= 0 ? low : high) = middle;
  }
  return low;
}

// The share s satisfies |s - w|^2 |F|^2 + pending rests <= 4 (c0 - w k) (E - w S): a cone over two
// lines. So the pairs (s, w) are a convex set, and the greatest s is concave in w. Outside it the
// function is the negative deficit, so that the search finds the set.
template <int axes>
std::optional<Strongest> strongest(const SplitBoundOf<axes>& bound) noexcept {
  const double size = bound.springs.norm();
  if (!(bound.spare > 0) || !(bound.energy > 0) || !(size > 0)) return std::nullopt;
  const auto left = [&](double w) {
    return 4.0 * (bound.spare - w * bound.half_slope) * (bound.energy - w * bound.stored) -
           bound.rests_under_way(w);
  };
  const auto force = [&](double w) {
    const double square = left(w);
    return square < 0 ? square : w * size + std::sqrt(square);
  };
  double low = 0.0, high = greatest_weight(bound);
  for (int i = 0; i < kHalvings; ++i) {
    const double first = low + 0.382 * (high - low);
    const double second = low + 0.618 * (high - low);
    if (force(first) < force(second)) {
      low = first;
    } else {
      high = second;
    }
  }
  if (left(low) < 0) return std::nullopt;
  return Strongest{low, std::min(1.0, force(low) / size)};
}

template std::optional<double> largest_weight(const SplitBoundOf<3>&,
                                              const AxisForces<3>&) noexcept;
template std::optional<double> largest_weight(const SplitBoundOf<6>&,
                                              const AxisForces<6>&) noexcept;
template std::optional<Strongest> strongest(const SplitBoundOf<3>&) noexcept;
template std::optional<Strongest> strongest(const SplitBoundOf<6>&) noexcept;

}  // namespace reckon::haptics
