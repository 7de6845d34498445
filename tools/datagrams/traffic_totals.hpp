// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sums over all datagrams of a run, and rates over its last seconds.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// Sums over all datagrams.
struct TrafficTotals {
  std::uint64_t datagrams = 0;
  std::uint64_t pdus = 0;
  std::uint64_t pdu_octets = 0;   ///< of readable PDUs
  std::uint64_t octets = 0;       ///< UDP payload
  std::uint64_t wire_octets = 0;  ///< including Ethernet, IP and UDP headers
  std::uint64_t errors = 0;
  std::chrono::nanoseconds first{};
  std::chrono::nanoseconds last{};

  void count(const PduRow& row) noexcept;
  void count(const peer::SourceDatagram& datagram) noexcept;

  /// PDU octets over octets on the wire, 0 to 1; 0 without traffic.
  [[nodiscard]] double efficiency() const noexcept;
  [[nodiscard]] double pdus_per_datagram() const noexcept;
  [[nodiscard]] double seconds() const noexcept;
};

/// Rates of increasing totals, over a sliding window.
class TrafficRates {
 public:
  struct Rates {
    double pdus = 0;       ///< [1/s]
    double datagrams = 0;  ///< [1/s]
    double bits = 0;       ///< on the wire [bit/s]
  };
  static constexpr std::chrono::nanoseconds kWindow = std::chrono::seconds(2);

  /// Rates over the last 2 to 4 s before `now`, or since the first call if that is shorter; 0 at
  /// first. `now` never decreases.
  [[nodiscard]] Rates at(const TrafficTotals& totals, std::chrono::nanoseconds now);

 private:
  struct Mark {
    std::chrono::nanoseconds time{};
    std::uint64_t pdus = 0, datagrams = 0, wire_octets = 0;
  };
  std::array<Mark, 2> marks_{};
  bool begun_ = false;
};

/// Rates over the whole run.
[[nodiscard]] TrafficRates::Rates mean_rates(const TrafficTotals& totals);

}  // namespace reckon::tools
