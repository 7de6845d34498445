// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A periodic pattern over the axes of an object, for effects that vary with the position.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reckon/haptics/effects/effect_slope.hpp"

namespace reckon::haptics {

/// Waves along up to three axes: w(p) = product of cos(2 pi p_i / length_i) over the axes with a
/// length above 0; 1 without any. One thread for each.
struct EffectWaves {
  Eigen::Vector3d lengths = Eigen::Vector3d::Zero();  ///< [m]; 0: constant along this axis

  /// w at a position, in [-1, 1]. @param place [m]
  [[nodiscard]] double at(const Eigen::Vector3d& place) const noexcept {
    double product = 1.0;
    for (int i = 0; i < 3; ++i)
      if (lengths[i] > 0.0) product *= std::cos(phase(place, i));
    return product;
  }
  /// dw/dp [1/m].
  [[nodiscard]] Eigen::Vector3d gradient(const Eigen::Vector3d& place) const noexcept {
    Eigen::Vector3d cosine(1.0, 1.0, 1.0), slope(0.0, 0.0, 0.0);
    for (int i = 0; i < 3; ++i) {
      if (!(lengths[i] > 0.0)) continue;
      cosine[i] = std::cos(phase(place, i));
      slope[i] = -std::sin(phase(place, i)) * 2.0 * std::numbers::pi / lengths[i];
    }
    return {slope[0] * cosine[1] * cosine[2], cosine[0] * slope[1] * cosine[2],
            cosine[0] * cosine[1] * slope[2]};
  }
  /// The shortest wavelength [m]; infinite without waves.
  [[nodiscard]] double shortest() const noexcept {
    double shortest = std::numeric_limits<double>::infinity();
    for (const double length : lengths)
      if (length > 0.0) shortest = std::min(shortest, length);
    return shortest;
  }
  /// shown_of_waves() for the shortest wave. @param way [m]
  [[nodiscard]] double shown(double way) const noexcept { return shown_of_waves(shortest(), way); }

 private:
  // Reduced to one wave, so that distant positions lose no precision.
  [[nodiscard]] double phase(const Eigen::Vector3d& place, int axis) const noexcept {
    return 2.0 * std::numbers::pi * std::remainder(place[axis], lengths[axis]) / lengths[axis];
  }
};

}  // namespace reckon::haptics
