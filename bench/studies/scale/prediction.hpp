// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the study predicts for peers as processes, beside what they use.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/hosts.hpp"
#include "reckon/bench/studies/scale/whole_text.hpp"

namespace reckon::bench {

/// A prediction within this share of the measurement is good.
inline constexpr double kGoodPrediction = 0.2;

/// Exercises drawn from a seed: 2 to 16 peers, 5 to 80 entities a peer, and all other sizes of the
/// study. @param base for the rest
[[nodiscard]] std::vector<ScaleSetting> drawn_settings(const ScaleSetting& base, std::size_t count,
                                                       std::uint64_t seed);

/// Runs the exercise as processes, with cost_samples() before and after it. @param simulated the
/// same exercise in simulated time  @param hosts of Meeting::hosts  @return none if `progress`
/// ended it  @throws as run_whole_peers() does
[[nodiscard]] std::optional<WholeRow> predicted_and_measured(const WholeRun& simulated,
                                                             Meeting meeting,
                                                             const HostsPlan& hosts,
                                                             const ScaleProgress& progress);
/// Predicts the CPU time of all rows. The ratios of the costs fit the samples of all rows, their
/// level only those of the row, since the load of the machine changes.
void predict(std::span<WholeRow> rows);

/// Predicted, measured and their ratio for datagrams, octets, CPU and error; a line for each row.
[[nodiscard]] std::string prediction_text(std::span<const WholeRow> rows);
[[nodiscard]] std::string prediction_json(std::span<const WholeRow> rows);

}  // namespace reckon::bench
