// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The updates of a turning ship, compressed as by a peer.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <span>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/compression/state_compressor.hpp"
#include "reckon/tests/support/capture_builder.hpp"

namespace reckon::test {

/// A datagram with one update of 7:1:3, plain if its form cannot represent it. Update 0 is plain.
/// `time` is since 1970-01-01 UTC; `state` gets the update.
inline Octets compressed_ship(peer::StateCompressor& compressor, int update,
                              std::chrono::nanoseconds time, pdu::EntityState& state) {
  const double turn = 0.1 * update;
  state.entity_id = {7, 1, 3};
  state.header.timestamp = pdu::to_dis_timestamp(time, true);
  state.location = {3e6 + 40 * std::cos(turn), 1e6 + 40 * std::sin(turn), 5e6};
  state.linear_velocity = {static_cast<float>(-8 * std::sin(turn)),
                           static_cast<float>(8 * std::cos(turn)), 0};
  state.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  EXPECT_TRUE(pdu::quantise(state, {}));
  std::array<std::byte, peer::StateCompressor::kRoom> octets;
  const auto made = compressor.compress(state, {3}, update == 0, time, octets);
  Octets datagram;
  if (made.size == 0) {
    append_pdu(datagram, state);
    return datagram;
  }
  pdu::CompressedStates states;
  states.header.timestamp = state.header.timestamp;
  states.simulation = {7, 1};
  states.form = compressor.form();
  states.number_of_states = 1;
  states.states.bytes = std::span(octets).first(made.size);
  append_pdu(datagram, states);
  return datagram;
}

}  // namespace reckon::test
