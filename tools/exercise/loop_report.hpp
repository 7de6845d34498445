// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Durations of the passes of the read, model and write loops, for reports.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/peer_threads.hpp"

namespace reckon::tools {

/// Passes of one loop.
struct LoopReport {
  peer::Percentiles took;
  std::uint64_t passes = 0;
  std::uint64_t overruns = 0;  ///< passes longer than a servo period
};

/// The three loops of a peer, or of several.
struct LoopReports {
  static constexpr std::array<std::string_view, 3> kNames{"read", "model", "write"};
  std::array<LoopReport, kNames.size()> all{};  ///< in the order of kNames

  /// Takes the worst times of both, and adds the counts.
  void add(const LoopReports& other);
};
[[nodiscard]] LoopReports loops_of(const peer::PeerThreads& threads);

/// The larger value of each percentile.
[[nodiscard]] peer::Percentiles worst(const peer::Percentiles& a, const peer::Percentiles& b);

/// Prints rows below spread_heading(); loops that have not run are omitted.
void print_loops(std::FILE* out, const LoopReports& loops);
/// {"read":{"passes":..,"us":{..},"overruns":..},"model":{..},"write":{..}}
[[nodiscard]] std::string loops_json(const LoopReports& loops);

}  // namespace reckon::tools
