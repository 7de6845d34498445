// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The simulated network of peers and of leaders: datagrams, and faults of the line.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/pdu/codec/codec.hpp"

namespace reckon::fuzz {

/// The behaviour of the line for each datagram until the calm.
struct LossyLine {
  double loss = 0.0, duplicates = 0.0;  ///< probabilities
  std::chrono::nanoseconds delay{};
  double jitter = 0.0;  ///< maximum additional delay, as a multiple: disorder

  friend bool operator==(const LossyLine&, const LossyLine&) = default;
};

/// A datagram on its way to one or more processes.
struct Datagram {
  std::vector<std::byte> octets;
  aoim::GroupIndex group;
  aoim::SourceAddress from;
};

/// Datagrams that the socket of a frozen process holds.
inline constexpr std::size_t kSocket = 256;

/// Address 10.b.c.d as IPv6 maps it.
[[nodiscard]] inline aoim::SourceAddress address_of(std::uint8_t b, std::uint8_t c, std::uint8_t d,
                                                    std::uint16_t port) noexcept {
  aoim::SourceAddress from;
  from.octets = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, b, c, d};
  from.port = port;
  return from;
}
/// Address of the forger, which no peer has.
[[nodiscard]] inline aoim::SourceAddress stranger() noexcept { return address_of(66, 6, 6, 6666); }

/// Adds the encoded PDU to a datagram.
template <typename Pdu>
void append(std::vector<std::byte>& octets, const Pdu& pdu) {
  std::array<std::byte, 1400> encoded;
  const std::size_t size = pdu::encode(pdu, encoded);
  octets.insert(octets.end(), encoded.begin(), encoded.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace reckon::fuzz
