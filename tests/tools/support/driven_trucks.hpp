// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams of trucks that drive in circles, some of which stop or leave, for the viewer.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tests/support/capture_builder.hpp"

namespace reckon::tools::trucks {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

inline constexpr nanoseconds kStart = seconds(1'700'000'000);
inline constexpr double kRadius = 6'378'137.0;  ///< [m], of the earth

/// A datagram and its arrival time.
struct Sent {
  test::Octets octets;
  nanoseconds time{};
};

/// Truck 1:2:`number` at `t` [s], in a circle of 50 m.
inline pdu::EntityState truck(std::uint16_t number, double t, std::string_view marking = "TRUCK") {
  const double angle = 0.2 * t + number;
  pdu::EntityState pdu;
  pdu.header.timestamp = pdu::to_dis_timestamp(kStart + nanoseconds(std::llround(1e9 * t)), true);
  pdu.entity_id = {1, 2, number};
  pdu.force_id = pdu::ForceId::friendly;
  pdu.entity_type.kind = pdu::EntityKind::platform;
  pdu.entity_type.domain = pdu::EntityDomain::land;
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  pdu.location = {kRadius, 50 * std::cos(angle), 50 * std::sin(angle)};
  pdu.linear_velocity = {0, static_cast<float>(-10 * std::sin(angle)),
                         static_cast<float>(10 * std::cos(angle))};
  pdu.marking.set(marking);
  return pdu;
}

/// `count` trucks, each with an update about every 0.5 s for `length` [s], one datagram each.
inline std::vector<Sent> drive(std::uint16_t count, double length) {
  std::vector<Sent> all;
  for (int k = 0; 0.5 * k < length; ++k) {
    for (std::uint16_t number = 1; number <= count; ++number) {
      const double t = 0.5 * k + 0.001 * number;
      Sent& sent = all.emplace_back();
      test::append_pdu(sent.octets, truck(number, t));
      sent.time = kStart + nanoseconds(std::llround(1e9 * t));
    }
  }
  return all;
}

inline peer::SourceDatagram datagram_of(const Sent& sent) {
  peer::SourceDatagram datagram;
  datagram.frame = 1;
  datagram.time = sent.time;
  datagram.source = peer::IpEndpoint::v4(0x0A000007, 3000);
  datagram.group = peer::IpEndpoint::v4(0xEFC00105, 3000);
  datagram.bytes = sent.octets;
  return datagram;
}

}  // namespace reckon::tools::trucks
