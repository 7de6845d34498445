// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/rate_limit.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

constexpr int kHalvings = 30;

// The part of `held` that is nearest to `wanted`.
Eigen::Vector3d fallen(const Eigen::Vector3d& held, const Eigen::Vector3d& wanted) noexcept {
  const double square = held.squaredNorm();
  if (!(square > 0)) return Eigen::Vector3d::Zero();
  return std::clamp(held.dot(wanted) / square, 0.0, 1.0) * held;
}

}  // namespace

bool within_reach(const Eigen::Vector3d& held, const Eigen::Vector3d& wanted,
                  double most) noexcept {
  return (wanted - fallen(held, wanted)).squaredNorm() <= most * most;
}

Eigen::Vector3d nearest_in_reach(const Eigen::Vector3d& held, const Eigen::Vector3d& wanted,
                                 double most) noexcept {
  const Eigen::Vector3d from = fallen(held, wanted);
  const Eigen::Vector3d way = wanted - from;
  const double length = way.norm();
  return length <= most ? wanted : Eigen::Vector3d(from + most / length * way);
}

// The forces within reach are a convex set that contains 0.
double part_in_reach(const Eigen::Vector3d& held, const Eigen::Vector3d& wanted,
                     double most) noexcept {
  if (within_reach(held, wanted, most)) return 1.0;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (within_reach(held, middle * wanted, most) ? low : high) = middle;
  }
  return low;
}

}  // namespace reckon::haptics
