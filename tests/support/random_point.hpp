// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <random>

namespace reckon::test {

/// A random point in a cube about the origin with half edge `reach` [m].
inline Eigen::Vector3d random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> x(-reach, reach);
  return {x(random), x(random), x(random)};
}

}  // namespace reckon::test
