// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a row grows with the number of peers at one density, and exercises larger than those that are
// run: least squares over the runs, with the error at which the largest of them is predicted from
// the others.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/text.hpp"

namespace reckon::bench {

/// Most peers of an exercise that is run. Larger ones are fitted.
inline constexpr std::size_t kMostWhole = 256;
/// Fewest sizes that a fit needs: two parameters, and one to predict.
inline constexpr std::size_t kFewestSizes = 3;
/// A quantity is unknown where its error is larger.
inline constexpr double kMostFitError = 0.1;
/// Beyond so many times the largest exercise nothing is extrapolated.
inline constexpr double kFarthest = 30;

/// Rows of a mechanism with as many entities a peer as `setting`, by number of peers, one a number.
[[nodiscard]] std::vector<const ScaleRow*> ladder_of(std::span<const ScaleRow> rows,
                                                     std::size_t mechanism,
                                                     const ScaleSetting& setting);
/// The same for the exercise of most peers.
[[nodiscard]] std::vector<const ScaleRow*> ladder_of(std::span<const ScaleRow> rows,
                                                     std::size_t mechanism);

/// By what a quantity of one peer grows, beside a constant.
enum class Growth : bool {
  edge,  ///< 1 / sqrt(peers): the share of the square world that is near its edge
  peers  ///< their number
};
struct SizedValue {
  double peers = 0, value = 0;
};
/// Least squares of two parameters. @param points two sizes at least
[[nodiscard]] double fitted(std::span<const SizedValue> points, Growth growth, double peers);
/// What all points but the last predict for it, as a share of it by which they are off.
/// @param points kFewestSizes or more  @param known part of that quantity that is not in the points
[[nodiscard]] double fit_error(std::span<const SizedValue> points, Growth growth, double known = 0);

/// An announcement of one of so many peers: it goes to all each second, with a Time Exchange and
/// the list of peers heard, in parts where that is long. With headers of UDP and IPv4 [octets].
[[nodiscard]] double announcement_octets(double peers);

/// THE list of quantities that are fitted.
inline constexpr std::string_view kFitted[] = {
    "sent_packets_per_s",  "sent_bytes_per_s",     "heard_packets_per_s", "heard_bytes_per_s",
    "heard_updates_per_s", "wanted_updates_per_s", "pose_error_p99_m",    "cpu_share"};

/// A row of an exercise that is not run. By place in kFitted.
struct FittedRow {
  std::size_t mechanism = 0, peers = 0, entities = 0;
  std::vector<std::optional<double>> values;  ///< none: error above kMostFitError, or cells that
                                              ///< share groups, or too far beyond the runs
  std::vector<double> errors;                 ///< fit_error()s
};
/// @param rows that were run: of kFewestSizes sizes with as many entities a peer as `setting`, else
/// there is none  @param is_divided groups_suffice() there
[[nodiscard]] std::optional<FittedRow> fitted_row(std::span<const ScaleRow> rows,
                                                  std::size_t mechanism,
                                                  const ScaleSetting& setting, bool is_divided);
/// Of all mechanisms.
[[nodiscard]] std::vector<FittedRow> fitted_rows(std::span<const ScaleRow> rows,
                                                 const ScaleSetting& setting);

/// Of log y over log x, by least squares; 0 for fewer than two values. All above 0.
[[nodiscard]] double log_slope(std::span<const double> x, std::span<const double> y);

/// By what power of the number of peers a measure of one peer grows. @param ladder of ladder_of()
[[nodiscard]] double power_of(std::span<const ScaleRow* const> ladder, std::string_view measure);

/// Such powers, of one mechanism.
struct GrowthRow {
  std::size_t mechanism = 0;
  double packets = 0, updates = 0, cpu = 0;  ///< heard, heard, of a core
};
/// Of all mechanisms, at the entities a peer of the largest exercise; empty for one size.
[[nodiscard]] std::vector<GrowthRow> growth_rows(std::span<const ScaleRow> rows);

[[nodiscard]] std::string growth_text(std::span<const GrowthRow> rows);
[[nodiscard]] std::string growth_json(std::span<const GrowthRow> rows);
/// A table for each exercise; `?` for what is unknown.
[[nodiscard]] std::string fitted_text(std::span<const FittedRow> rows);
[[nodiscard]] std::string fitted_json(std::span<const FittedRow> rows);

}  // namespace reckon::bench
