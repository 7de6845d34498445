// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Statistics of the traffic, four times a second: rates, delay, loss and prediction errors; kept as
// long as the history.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "reckon/tools/datagrams/trailer_loss.hpp"
#include "reckon/tools/viewer/history/received_world.hpp"

namespace reckon::tools {

/// Over the second before `time`. Absent values are unknown.
struct NumbersSample {
  std::chrono::nanoseconds time{};
  double pdu_per_s = 0, bit_per_s = 0;            ///< UDP payloads
  std::optional<double> lost_share;               ///< by the sequence numbers of trailers
  std::optional<double> delay_median, delay_p95;  ///< [s], one way, including the offset of the
                                                  ///< clocks
  std::optional<double> error_mean, error_worst;  ///< [m], of predictions at updates
};

/// One thread. Holds at most kMostSamples; older ones are dropped.
class TrafficNumbers {
 public:
  static constexpr std::chrono::nanoseconds kEvery = std::chrono::milliseconds(250);
  static constexpr std::size_t kMostSamples = 1 << 16;

  /// Counts a PDU of the present datagram.
  void pdu(const PduRow& row, const peer::SourceDatagram& datagram);
  /// Ends the present datagram.
  void datagram(const peer::SourceDatagram& datagram, const UpdateJumps& jumps);
  /// Advances the time to `now`: adds a sample if one is due.
  void pass(std::chrono::nanoseconds now);
  void forget_before(std::chrono::nanoseconds time);

  /// The newest sample at `time`; null before the first.
  [[nodiscard]] const NumbersSample* at(std::chrono::nanoseconds time) const;

 private:
  struct Part {
    std::uint64_t pdus = 0, octets = 0, received = 0;
    std::int64_t lost = 0;
    UpdateJumps jumps;
    std::vector<double> delays;  // [s], at most kMostDelays
  };
  static constexpr std::size_t kParts = 4;
  static constexpr std::size_t kMostDelays = 512;

  [[nodiscard]] NumbersSample sample(std::chrono::nanoseconds now) const;

  TrailerLoss loss_;
  std::array<Part, kParts> parts_;
  std::size_t part_ = 0;
  std::optional<std::chrono::nanoseconds> next_;
  std::deque<NumbersSample> samples_;
};

}  // namespace reckon::tools
