// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A height field over a plane: a table of heights, repeated periodically. Immutable.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::haptics {

/// Heights in [0, 1] at the points of a grid, and between them by cubic polynomials (Catmull and
/// Rom), whose slope is continuous. Places are in periods: the table covers [0, 1) x [0, 1).
class HeightMap {
 public:
  /// @param columns, rows at least 4 each  @param heights row by row, along y upward
  /// @throws std::invalid_argument if the table has another size
  HeightMap(std::size_t columns, std::size_t rows, std::vector<float> heights);
  /// A homogeneous field of 64 x 64 random heights, smoothed; equal on all hosts.
  [[nodiscard]] static HeightMap random(std::uint64_t seed);

  /// @param place of any size  @return about [0, 1]; the polynomials overshoot a little
  [[nodiscard]] double at(const Eigen::Vector2d& place) const noexcept;
  /// d at / d place, exact. It reads sixteen heights, in tens of nanoseconds.
  [[nodiscard]] Eigen::Vector2d gradient(const Eigen::Vector2d& place) const noexcept;

  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  /// Wavelength of a sine wave with the same spread of heights and of slopes, for a period of
  /// `size` [m]; infinite for a flat map.
  [[nodiscard]] double wavelength(const Eigen::Vector2d& size) const noexcept;

 private:
  struct Weights;
  [[nodiscard]] double sum(const Weights& x, const double* across, const Weights& y,
                           const double* along) const noexcept;

  std::size_t columns_, rows_;
  std::vector<float> heights_;
};

}  // namespace reckon::haptics
