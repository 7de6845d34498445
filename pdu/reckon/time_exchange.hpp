// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time exchange (experimental PDU 143): a peer repeats to each other peer the send time of that
// peer's latest datagram, with its arrival time, so that both can compute the offset of their
// clocks. Times are microseconds of UTC modulo 2^32, as in the trailer of each datagram.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// The latest datagram that the sender of this PDU has received from one peer.
struct TimeEcho {
  std::uint32_t epoch = 0;  ///< of that peer, from the trailer of its datagram
  std::uint32_t sent = 0;   ///< send time in that trailer, by that peer's clock
  std::uint32_t heard = 0;  ///< arrival time, by the clock of the sender of this PDU
};

struct TimeExchange {
  static constexpr PduType kPduType = PduType::time_exchange;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Time Exchange";
  using Echoes = Records<TimeEcho, std::uint16_t>;

  PduHeader header = header_of<TimeExchange>();
  SimulationAddress simulation;  ///< of the sender of this PDU
  std::uint32_t epoch = 0;       ///< of the sender, as in its trailers
  std::uint16_t padding = 0;
  std::span<const std::byte> echoes;  ///< 12 n octets, read with records_of<TimeEcho>
};

constexpr void fields(auto& visitor, Is<TimeExchange> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("epoch", pdu.epoch);
  visitor.count("number_of_echoes", pdu.echoes, TimeExchange::Echoes{});
  visitor("padding", pdu.padding);
  visitor.records("echoes", pdu.echoes, TimeExchange::Echoes{});
}
static_assert(kFixedSize<TimeExchange> == 24);
static_assert(kFixedSize<TimeEcho> == 12);

}  // namespace reckon::pdu
