// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The poses of many entities at one instant: extrapolate() of drm.hpp over a structure of arrays,
// for whoever needs the whole world at once (interest matching, a viewer, a study).
//
// Terms that a model does not have are stored as zeros, so that all models go through one loop
// without a branch. The loop is compiled for the baseline, AVX2 and AVX-512 and chosen when the
// program starts; all three give the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "reckon/deadreckon/motion/kinematic_state.hpp"

namespace reckon::deadreckon {

/// `count` columns of numbers in one piece of memory. Not synchronised; resize() alone allocates.
///
/// Each column starts on a line of the cache, 576 octets farther into its page than the one before:
/// columns at the same place of a page would all want the same few lines of the first-level cache,
/// and numbers across two lines cost two accesses. Together that halves the time of a pass.
template <std::size_t count>
class StaggeredColumns {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return rows_; }
  [[nodiscard]] double* data(std::size_t column) noexcept {
    return reinterpret_cast<double*>(lines_.data() + column * stride_);
  }
  [[nodiscard]] const double* data(std::size_t column) const noexcept {
    return reinterpret_cast<const double*>(lines_.data() + column * stride_);
  }
  [[nodiscard]] std::span<const double> column(std::size_t i) const noexcept {
    return {data(i), rows_};
  }
  /// Keeps rows that were there; new ones hold `fresh`, a number for each column.
  void resize(std::size_t rows, const std::array<double, count>& fresh) {
    StaggeredColumns next;
    next.rows_ = rows;
    next.stride_ = (rows + kRowsInPage - 1) / kRowsInPage * kLinesInPage + kStaggerLines;
    next.lines_.resize(count * next.stride_);
    for (std::size_t i = 0; i < count; ++i) {
      const std::span<const double> kept = column(i).first(std::min(rows, rows_));
      double* const end = std::copy(kept.begin(), kept.end(), next.data(i));
      std::fill(end, next.data(i) + rows, fresh[i]);
    }
    *this = std::move(next);
  }

 private:
  static constexpr std::size_t kLineSize = 64;  // octets
  static constexpr std::size_t kLinesInPage = 4096 / kLineSize;
  static constexpr std::size_t kRowsInPage = 4096 / sizeof(double);
  static constexpr std::size_t kStaggerLines = 9;
  struct alignas(kLineSize) Line {
    std::array<double, kLineSize / sizeof(double)> numbers{};
  };

  std::vector<Line> lines_;
  std::size_t rows_ = 0;
  std::size_t stride_ = 0;  // lines from one column to the next
};

/// Poses as columns of numbers, reference axes but for the angular velocity.
class PoseTable {
 public:
  /// Position x y z [m], orientation w x y z, velocity x y z [m/s], angular velocity x y z [rad/s].
  static constexpr std::size_t kColumns = 13;

  void resize(std::size_t rows) { columns_.resize(rows, {}); }
  [[nodiscard]] std::size_t size() const noexcept { return columns_.size(); }
  [[nodiscard]] Pose pose(std::size_t row) const noexcept;
  [[nodiscard]] std::span<const double> column(std::size_t i) const noexcept {
    return columns_.column(i);
  }
  [[nodiscard]] double* data(std::size_t i) noexcept { return columns_.data(i); }

 private:
  StaggeredColumns<kColumns> columns_;
};

/// The predictors of many entities. Not synchronised; only resize() allocates.
class KinematicTable {
 public:
  /// Position 3, orientation 4, velocity 3, acceleration 3, angular velocity 3, time of the update
  /// [s], and 1 where velocity and acceleration are held in body axes.
  static constexpr std::size_t kColumns = 18;

  /// Keeps rows that were there; new ones stand at the origin.
  void resize(std::size_t rows);
  [[nodiscard]] std::size_t size() const noexcept { return columns_.size(); }

  /// The predictor of one entity, of the instant `time` [s]. `row` < size(). The state has to be
  /// finite (is_finite).
  void set(std::size_t row, const KinematicState& state, double time) noexcept;

  /// All poses at `now` [s], as extrapolate(state, now - time) gives them in the reading
  /// component_rate, to within rounding: 4e-16 of the numbers that are added (the order of the
  /// products differs). `out` has size() rows. Cost: about that of reading and writing the columns
  /// once; rows that turned by more than 1 rad since their update are done one by one.
  void extrapolate(double now, PoseTable& out) const noexcept;

  [[nodiscard]] std::span<const double> column(std::size_t i) const noexcept {
    return columns_.column(i);
  }

 private:
  [[nodiscard]] KinematicState state(std::size_t row) const noexcept;

  StaggeredColumns<kColumns> columns_;
};

}  // namespace reckon::deadreckon
