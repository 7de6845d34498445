// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What one whole peer took, as a table and JSON Lines, with the costs that follow.
#pragma once

#include <span>
#include <string>

#include "reckon/bench/studies/scale/measured_peer.hpp"

namespace reckon::bench {

/// Runs of one peer in worlds of growing size, and what is fitted to all but the last, which it
/// then predicts.
struct MeasuredReport {
  std::vector<MeasuredPeer> runs;

  [[nodiscard]] PeerCosts costs() const;
  /// Share by which the costs are off in the last run; 0 for a single one, which they are made
  /// from.
  [[nodiscard]] double prediction_error() const;
  /// Of datagrams a second, and of CPU, over the entities of the world.
  [[nodiscard]] double datagram_slope() const;
  [[nodiscard]] double cpu_slope() const;
};

[[nodiscard]] std::string measured_text(const MeasuredReport& report);
[[nodiscard]] std::string measured_json(const MeasuredReport& report);

}  // namespace reckon::bench
