// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagram trailer (experimental PDU 141): the last 24 octets of each datagram between peers of
// this project, so that loss, reordering and delay can be counted (DIS itself has no sequence
// numbers).
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::pdu {

struct DatagramTrailer {
  static constexpr PduType kPduType = PduType::datagram_trailer;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Datagram Trailer";

  PduHeader header = header_of<DatagramTrailer>();
  /// Number of the sender's datagram to one group, from 1; 2^32 - 1 is followed by 0.
  std::uint32_t sequence = 0;
  /// Epoch of the sending process, as in its Presence; identifies the sender.
  std::uint32_t epoch = 0;
  /// UTC in microseconds, modulo 2^32 (71.6 min); see trailer_time and trailer_age.
  std::uint32_t send_time = 0;
};

inline constexpr std::size_t kDatagramTrailerSize = 24;  ///< octets

static_assert(kFixedSize<DatagramTrailer> == kDatagramTrailerSize);

/// The field for a time of UTC.
[[nodiscard]] constexpr std::uint32_t trailer_time(std::chrono::nanoseconds utc) noexcept {
  return static_cast<std::uint32_t>(
      static_cast<std::uint64_t>(utc.count() / 1000));  // modulo 2^32 by definition
}

/// Signed time from `send_time` to `utc_now`: the one-way delay plus the clock offset; correct
/// within +-35 min.
[[nodiscard]] constexpr std::chrono::nanoseconds trailer_age(
    std::uint32_t send_time, std::chrono::nanoseconds utc_now) noexcept {
  const auto units = static_cast<std::int32_t>(trailer_time(utc_now) - send_time);
  return std::chrono::microseconds(units);
}

}  // namespace reckon::pdu
