// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a row grows with the number of peers at one density, and estimates for exercises too large to
// run: least squares over the runs. The error comes from predicting the largest run from the
// others.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/text.hpp"

namespace reckon::bench {

/// Most peers of an exercise that is run. Larger exercises are fitted.
inline constexpr std::size_t kMostWhole = 256;
/// Fewest sizes that a fit needs: two parameters, and one to predict.
inline constexpr std::size_t kFewestSizes = 3;
/// A quantity with a larger error is unknown.
inline constexpr double kMostFitError = 0.1;
/// Largest extrapolation, as a multiple of the largest exercise.
inline constexpr double kFarthest = 30;

/// Rows of a mechanism with as many entities a peer as `setting`, one for each number of peers, in
/// ascending order.
[[nodiscard]] std::vector<const ScaleRow*> ladder_of(std::span<const ScaleRow> rows,
                                                     std::size_t mechanism,
                                                     const ScaleSetting& setting);
/// The same, with as many entities a peer as the exercise of most peers.
[[nodiscard]] std::vector<const ScaleRow*> ladder_of(std::span<const ScaleRow> rows,
                                                     std::size_t mechanism);

/// The term by which a quantity of one peer grows, besides a constant.
enum class Growth : bool {
  edge,  ///< 1 / sqrt(peers): the share of the square world that is near its edge
  peers  ///< their number
};
struct SizedValue {
  double peers = 0, value = 0;
};
/// Least squares of two parameters. @param points two sizes at least
[[nodiscard]] double fitted(std::span<const SizedValue> points, Growth growth, double peers);
/// Predicts the last point from the others. Returns the signed error relative to the true quantity.
/// @param points kFewestSizes or more  @param known part of the quantity that is not in the points
[[nodiscard]] double fit_error(std::span<const SizedValue> points, Growth growth, double known = 0);

/// Size of an announcement among so many peers, with headers of UDP and IPv4 [octets]. Each peer
/// sends one a second to all, with a Time Exchange and PeersHeard. A long list is sent in parts.
[[nodiscard]] double announcement_octets(double peers);

/// THE list of quantities that are fitted.
inline constexpr std::string_view kFitted[] = {
    "sent_packets_per_s",  "sent_bytes_per_s",     "heard_packets_per_s", "heard_bytes_per_s",
    "heard_updates_per_s", "wanted_updates_per_s", "pose_error_p99_m",    "cpu_share"};

/// Fitted row of an exercise that is not run. Vectors are in the order of kFitted.
struct FittedRow {
  std::size_t mechanism = 0, peers = 0, entities = 0;
  std::vector<std::optional<double>> values;  ///< none: error above kMostFitError, cells share
                                              ///< groups, or too far beyond the runs
  std::vector<double> errors;                 ///< fit_error()s
};
/// None for fewer than kFewestSizes sizes. @param rows of the runs; only rows with as many entities
/// a peer as `setting` count  @param is_divided groups_suffice(setting)
[[nodiscard]] std::optional<FittedRow> fitted_row(std::span<const ScaleRow> rows,
                                                  std::size_t mechanism,
                                                  const ScaleSetting& setting, bool is_divided);
/// The fitted rows of all mechanisms.
[[nodiscard]] std::vector<FittedRow> fitted_rows(std::span<const ScaleRow> rows,
                                                 const ScaleSetting& setting);

/// Slope of log y over log x by least squares; 0 for fewer than two values. All values > 0.
[[nodiscard]] double log_slope(std::span<const double> x, std::span<const double> y);

/// Power of the number of peers by which a measure of one peer grows. @param ladder of ladder_of()
[[nodiscard]] double power_of(std::span<const ScaleRow* const> ladder, std::string_view measure);

/// The powers of one mechanism.
struct GrowthRow {
  std::size_t mechanism = 0;
  double packets = 0, updates = 0, cpu = 0;  ///< received; CPU: share of a core
};
/// For all mechanisms, with as many entities a peer as the largest exercise; empty for one size.
[[nodiscard]] std::vector<GrowthRow> growth_rows(std::span<const ScaleRow> rows);

[[nodiscard]] std::string growth_text(std::span<const GrowthRow> rows);
[[nodiscard]] std::string growth_json(std::span<const GrowthRow> rows);
/// A table for each exercise; `?` for an unknown value.
[[nodiscard]] std::string fitted_text(std::span<const FittedRow> rows);
[[nodiscard]] std::string fitted_json(std::span<const FittedRow> rows);

}  // namespace reckon::bench
