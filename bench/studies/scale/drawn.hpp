// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How far the model may be trusted: exercises that a seed draws, each run by whole simulated peers
// and by the model, and what may differ by how much.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/whole_text.hpp"

namespace reckon::bench {

/// Most exercises that are drawn at once.
inline constexpr std::size_t kMostDrawn = 1000;

/// What whole peers and the model both tell, and the share of the model's by which it may differ.
struct DrawnBar {
  std::string_view measure;  ///< of scale_measures()
  std::string_view title;    ///< of a column
  double most;
};
inline constexpr std::array kDrawnBars{
    DrawnBar{"sent_packets_per_s", "SENT", 0.1},     DrawnBar{"heard_packets_per_s", "HEARD", 0.1},
    DrawnBar{"sent_bytes_per_s", "B SENT", 0.2},     DrawnBar{"heard_bytes_per_s", "B HEARD", 0.2},
    DrawnBar{"wanted_updates_per_s", "WANTED", 0.2}, DrawnBar{"pose_error_p99_m", "POSE", 0.2},
};

/// One of the exercises of a seed: 8 .. 64 peers with 4 .. 20 entities each, ticks, movement, pool,
/// tiers and compression. The same for the same seed and number, on any host.
[[nodiscard]] ScaleSetting drawn_exercise(std::uint64_t seed, std::size_t number);

/// Runs one both ways; some seconds of one core. @param progress false ends it: nothing is good
[[nodiscard]] WholeRow run_drawn(const ScaleSetting& setting, const ScaleProgress& progress = {});

/// What whole peers have over what the model says, a share of it.
[[nodiscard]] double difference_of(const WholeRow& row, const DrawnBar& bar);
/// Whether any of these is beyond its bar.
[[nodiscard]] bool is_beyond(const WholeRow& row);

[[nodiscard]] std::string drawn_text(std::span<const WholeRow> rows);
/// A line of kind "drawn" for each.
[[nodiscard]] std::string drawn_json(std::span<const WholeRow> rows);

}  // namespace reckon::bench
