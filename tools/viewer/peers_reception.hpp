// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reception statistics of a program's own peers, from the counters of their loops. They include the
// impairment of the scene, which a separate listener does not receive.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "reckon/peer/peer.hpp"

namespace reckon::tools {

/// Over the second before `time`, of all peers together. Absent values are unknown.
struct ReceptionSample {
  std::chrono::nanoseconds time{};
  std::optional<double> lost_share;               ///< by the sequence numbers of trailers
  std::optional<double> delay_median, delay_p95;  ///< [s], one way, rounded up by 1/16 at most
};

/// One thread, the reader of the peers' views.
class PeersReception {
 public:
  static constexpr std::chrono::nanoseconds kEvery = std::chrono::milliseconds(250);

  /// @param peer outlives it
  void add(const peer::Peer& peer) { peers_.push_back(&peer); }
  /// A sample if one is due; nothing without peers, and in the first second.
  /// @param now of any monotonic clock
  [[nodiscard]] std::optional<ReceptionSample> look(std::chrono::nanoseconds now);

 private:
  static constexpr std::size_t kParts = 4;  // of a second
  struct Look {
    peer::TransitTimes::Counts came{};
    std::int64_t lost = 0;
  };
  [[nodiscard]] Look sum() const;

  std::vector<const peer::Peer*> peers_;
  std::deque<Look> looks_;  // oldest first
  std::optional<std::chrono::nanoseconds> next_;
};

}  // namespace reckon::tools
