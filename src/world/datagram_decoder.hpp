// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// From a datagram to updates of entities: takes a bundle apart, refuses what is damaged or of
// another exercise, and joins an Entity State with the force model that follows it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/energy_account_record.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"
#include "reckon/peer/counters/counters.hpp"

namespace reckon::peer {

/// Something that another peer said, decoded and bounded.
struct Inbound {
  enum class Kind : std::uint8_t { entity, stop_freeze, start_resume };
  Kind kind = Kind::entity;
  pdu::EntityId entity;          ///< whose update; receiver of a stop or start
  pdu::EntityId originator;      ///< of a stop or start
  std::uint32_t request_id = 0;  ///< of a stop or start
  bool has_state = false, has_model = false, has_account = false;
  pdu::EntityState state;  ///< its variable parameters are a view of the datagram's octets
  pdu::HapticRecord model;
  pdu::EnergyAccountRecord account;  ///< the one that names our hand
};

/// The decoder. One thread; no allocation, never throws.
class DatagramDecoder {
 public:
  /// @param exercise PDUs of other exercises are dropped. @param counters outlives the decoder.
  DatagramDecoder(std::uint8_t exercise, Counters& counters);

  /// What a datagram says, good until the next call and while its octets are. @param own our hand,
  /// whose accounts are picked out.
  [[nodiscard]] std::span<const Inbound> decode(std::span<const std::byte> datagram,
                                                const pdu::EntityId& own) noexcept;

 private:
  static constexpr std::size_t kMaxUpdates = 128;  // 9 to 40 PDUs fit a bundle below the MTU

  void take_pdu(const pdu::BundledPdu& pdu, const pdu::EntityId& own) noexcept;
  void take_attribute(std::span<const std::byte> bytes, const pdu::EntityId& own) noexcept;
  void take_control(const pdu::BundledPdu& pdu) noexcept;
  Inbound* stage(Inbound::Kind kind, const pdu::EntityId& entity) noexcept;

  std::uint8_t exercise_;
  std::array<Inbound, kMaxUpdates> staged_{};
  std::size_t count_ = 0;

  Counter& pdus_;
  Counter& malformed_;
  Counter& foreign_;
  Counter& unknown_;
  Counter& overflow_;
};

}  // namespace reckon::peer
