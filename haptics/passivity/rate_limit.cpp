// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/rate_limit.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

constexpr int kHalvings = 30;

// The fraction of `held` nearest to `wanted`.
template <int axes>
AxisForces<axes> fallen(const AxisForces<axes>& held, const AxisForces<axes>& wanted) noexcept {
  const double square = held.squaredNorm();
  if (!(square > 0)) return AxisForces<axes>::Zero();
  return std::clamp(held.dot(wanted) / square, 0.0, 1.0) * held;
}

}  // namespace

template <int axes>
bool within_reach(const AxisForces<axes>& held, const AxisForces<axes>& wanted,
                  double most) noexcept {
  return (wanted - fallen(held, wanted)).squaredNorm() <= most * most;
}

template <int axes>
AxisForces<axes> nearest_in_reach(const AxisForces<axes>& held, const AxisForces<axes>& wanted,
                                  double most) noexcept {
  const AxisForces<axes> from = fallen(held, wanted);
  const AxisForces<axes> way = wanted - from;
  const double length = way.norm();
  return length <= most ? wanted : AxisForces<axes>(from + most / length * way);
}

// The forces within reach are a convex set that contains 0.
template <int axes>
double part_in_reach(const AxisForces<axes>& held, const AxisForces<axes>& wanted,
                     double most) noexcept {
  if (within_reach(held, wanted, most)) return 1.0;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (within_reach<axes>(held, middle * wanted, most) ? low : high) = middle;
  }
  return low;
}

template bool within_reach<3>(const AxisForces<3>&, const AxisForces<3>&, double) noexcept;
template bool within_reach<6>(const AxisForces<6>&, const AxisForces<6>&, double) noexcept;
template AxisForces<3> nearest_in_reach<3>(const AxisForces<3>&, const AxisForces<3>&,
                                           double) noexcept;
template AxisForces<6> nearest_in_reach<6>(const AxisForces<6>&, const AxisForces<6>&,
                                           double) noexcept;
template double part_in_reach<3>(const AxisForces<3>&, const AxisForces<3>&, double) noexcept;
template double part_in_reach<6>(const AxisForces<6>&, const AxisForces<6>&, double) noexcept;

}  // namespace reckon::haptics
