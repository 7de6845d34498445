// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams of haptic entities on the equator at longitude 0, where geocentric x is up, y east and
// z north, so that every force can be computed by hand.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/capture_builder.hpp"

namespace reckon::test {

inline constexpr double kGround = 6378137.0;  ///< geocentric x [m] of the ground

/// A ball of 10 mm at rest over the ground, 500 N/m and 1e6 N/m^3.
struct Ball {
  std::uint16_t entity = 1;
  double up = 0, east = 0, north = 0;  ///< [m]
  double rising = 0;                   ///< velocity upwards [m/s]
  double k1 = 500, k3 = 1e6;
  std::chrono::nanoseconds time{};  ///< of its timestamp, UTC
  std::optional<pdu::EnergyAccountRecord> account = std::nullopt;
};

inline pdu::EntityState state_of(const Ball& ball) {
  pdu::EntityState state;
  state.header.timestamp = pdu::to_dis_timestamp(ball.time, true);
  state.header.pdu_status = pdu::kStatusCoupledExtension;
  state.entity_id = {1, 2, ball.entity};
  state.force_id = pdu::ForceId::friendly;
  state.location = {kGround + ball.up, ball.east, ball.north};
  state.linear_velocity = {static_cast<float>(ball.rising), 0, 0};
  state.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  state.marking.set("BALL" + std::to_string(ball.entity));
  return state;
}

inline pdu::HapticRecord record_of(const Ball& ball) {
  pdu::HapticRecord record;
  record.kind = pdu::ForceModelKind::sphere;
  record.validity_ms = 1000;
  record.k1 = static_cast<float>(ball.k1);
  record.k3 = static_cast<float>(ball.k3);
  record.normal = {0, 0, -1};
  record.radius = 0.01F;
  return record;
}

/// Appends the Attribute PDU with a force model, followed by an energy account.
inline void append_attribute(Octets& datagram, const pdu::EntityState& state,
                             const pdu::HapticRecord& record,
                             const std::optional<pdu::EnergyAccountRecord>& account = {}) {
  std::array<std::byte, 256> buffer{};
  pdu::Attribute attribute;
  attribute.header.timestamp = state.header.timestamp;
  pdu::AttributeWriter writer(buffer, attribute);
  (void)writer.begin_set(state.entity_id);
  (void)writer.add(record);
  if (account.has_value()) (void)writer.add(*account);
  datagram.insert(datagram.end(), buffer.begin(),
                  buffer.begin() + static_cast<std::ptrdiff_t>(writer.finish()));
}

/// Entity State and Attribute of one ball.
inline Octets datagram_of(const Ball& ball) {
  Octets datagram;
  const pdu::EntityState state = state_of(ball);
  append_pdu(datagram, state);
  append_attribute(datagram, state, record_of(ball), ball.account);
  return datagram;
}

}  // namespace reckon::test
