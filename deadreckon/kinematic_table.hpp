// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The poses of many entities at one instant: extrapolate() of drm.hpp over a structure of arrays,
// for whoever needs the whole world at once (interest matching, a viewer, a study).
//
// Terms that a model does not have are stored as zeros, so that all models go through one loop
// without a branch. The loop is compiled for the baseline, AVX2 and AVX-512 and chosen when the
// program starts; all three give the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "deadreckon/kinematic_state.hpp"

namespace reckon::deadreckon {

/// Poses as columns of numbers, reference axes but for the angular velocity.
class PoseTable {
 public:
  /// Position x y z [m], orientation w x y z, velocity x y z [m/s], angular velocity x y z [rad/s].
  static constexpr std::size_t kColumns = 13;

  void resize(std::size_t rows);
  [[nodiscard]] std::size_t size() const noexcept { return columns_[0].size(); }
  [[nodiscard]] Pose pose(std::size_t row) const noexcept;
  [[nodiscard]] const std::vector<double>& column(std::size_t i) const { return columns_[i]; }
  [[nodiscard]] double* data(std::size_t i) noexcept { return columns_[i].data(); }

 private:
  std::array<std::vector<double>, kColumns> columns_;
};

/// The predictors of many entities. Not synchronised; only resize() allocates.
class KinematicTable {
 public:
  /// Position 3, orientation 4, velocity 3, acceleration 3, angular velocity 3, time of the update
  /// [s], and 1 where velocity and acceleration are held in body axes.
  static constexpr std::size_t kColumns = 18;

  /// Keeps rows that were there; new ones stand at the origin.
  void resize(std::size_t rows);
  [[nodiscard]] std::size_t size() const noexcept { return columns_[0].size(); }

  /// The predictor of one entity, of the instant `time` [s]. `row` < size(). The state has to be
  /// finite (is_finite).
  void set(std::size_t row, const KinematicState& state, double time) noexcept;

  /// All poses at `now` [s], as extrapolate(state, now - time) gives them in the reading
  /// component_rate, to within rounding: 4e-16 of the numbers that are added (the order of the
  /// products differs). `out` has size() rows. Cost: about that of reading and writing the columns
  /// once; rows that turned by more than 1 rad since their update are done one by one.
  void extrapolate(double now, PoseTable& out) const noexcept;

  [[nodiscard]] const std::vector<double>& column(std::size_t i) const { return columns_[i]; }

 private:
  [[nodiscard]] KinematicState state(std::size_t row) const noexcept;

  std::array<std::vector<double>, kColumns> columns_;
};

}  // namespace reckon::deadreckon
