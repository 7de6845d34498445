// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The columns of every recorded motion: t_s, px_m, py_m, pz_m. Private to the readers of tracks.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "reckon/peer/tracks/csv_reader.hpp"

namespace reckon::peer {

/// Time and position of the rows of a table, which outlives this.
class MotionColumns {
 public:
  /// @throws CsvError if a column is missing.
  explicit MotionColumns(const CsvReader& csv);

  /// [s] of this row; grows from row to row.  @throws CsvError if it does not.
  [[nodiscard]] double time();
  /// [m] of this row.
  [[nodiscard]] Eigen::Vector3d position() const;
  /// Column of t_s, for error messages.
  [[nodiscard]] std::size_t time_column() const noexcept { return time_; }

 private:
  const CsvReader& csv_;
  std::size_t time_, x_, y_, z_;
  std::optional<double> last_;
};

}  // namespace reckon::peer
