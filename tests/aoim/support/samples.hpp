// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// PDUs, records and sinks that several tests of this folder share.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim::test {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using Octets = std::vector<std::byte>;

struct Datagram {
  GroupIndex group;
  Octets octets;
};

/// Keeps copies of all that is emitted.
struct Collector {
  std::vector<Datagram> datagrams;
  void operator()(GroupIndex group, std::span<const std::byte> octets) {
    datagrams.push_back({group, Octets(octets.begin(), octets.end())});
  }
};

inline pdu::EntityState entity_state(std::uint16_t entity, std::uint32_t appearance = 0) {
  pdu::EntityState state;
  state.entity_id = {7, 1, entity};
  state.appearance = appearance;
  state.header.timestamp = 1000u + entity;
  return state;
}

template <typename T>
Octets encoded(const T& pdu) {
  Octets octets(pdu::wire_size(pdu));
  octets.resize(pdu::encode(pdu, octets));
  return octets;
}

/// A PDU of any type with `body` octets behind its header.
inline Octets raw_pdu(pdu::PduType type, std::size_t body) {
  Octets octets(pdu::kHeaderSize + body, std::byte{0x5A});
  octets[0] = std::byte{7};
  octets[1] = std::byte{1};
  octets[2] = static_cast<std::byte>(type);
  pdu::store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  return octets;
}

template <typename Record>
Octets record_octets(const Record& record) {
  Octets octets(pdu::kFixedSize<Record>);
  (void)pdu::store_record(record, octets);
  return octets;
}

inline Octets haptic_record(float k1) {
  pdu::HapticRecord record;
  record.k1 = k1;
  return record_octets(record);
}

inline Octets energy_record(std::uint16_t counterpart, double given) {
  pdu::EnergyAccountRecord record;
  record.counterpart = {9, 9, counterpart};
  record.given = given;
  return record_octets(record);
}

inline Octets operator+(Octets a, const Octets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline pdu::Presence presence_of(std::uint16_t application, std::uint32_t epoch,
                                 std::uint32_t started = 100) {
  pdu::Presence presence;
  presence.simulation = {7, application};
  presence.epoch = epoch;
  presence.started = started;
  presence.scene_hash = 0xABCDEF;
  presence.pool_size = 256;
  presence.cell_scheme = pdu::CellScheme::hexagonal;
  presence.cell_size = 125.0F;
  return presence;
}

/// Substitute for a one-way function: no test inverts it.
inline pdu::ChainLink scrambled(const pdu::ChainLink& link, std::uint32_t number) noexcept {
  std::uint64_t state = 0x9E3779B97F4A7C15u * (number + 1u);
  pdu::ChainLink value{};
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      state = (state ^ link[i] ^ value[i]) * 0xBF58476D1CE4E5B9u;
      state ^= state >> 29;
      value[i] = static_cast<std::uint8_t>(state >> 56);
    }
  }
  return value;
}

/// Substitute for a keyed hash function.
inline pdu::ChainLink scrambled_with(const pdu::ChainLink& key,
                                     std::span<const std::byte> octets) noexcept {
  pdu::ChainLink value = key;
  for (std::size_t i = 0; i < octets.size(); i += value.size()) {
    for (std::size_t k = i; k < std::min(i + value.size(), octets.size()); ++k)
      value[k - i] ^= std::to_integer<std::uint8_t>(octets[k]);
    value = scrambled(value, static_cast<std::uint32_t>(i));
  }
  return value;
}

}  // namespace reckon::aoim::test
