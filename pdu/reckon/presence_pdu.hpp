// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Presence (experimental PDU 140): a peer announces on the base group itself, its world, and the
// division of that world into groups. 160 octets.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

inline constexpr std::uint16_t kPresenceInterop = 0x0001;   ///< sends plain DIS without trailers
inline constexpr std::uint16_t kPresenceLeaving = 0x0002;   ///< last announcement before a stop
inline constexpr std::uint16_t kPresenceHaptic = 0x0004;    ///< has at least one haptic entity
inline constexpr std::uint16_t kPresenceObserver = 0x0008;  ///< sends no entities
/// Has held its simulation address for two seconds and keeps it against newcomers.
inline constexpr std::uint16_t kPresenceEstablished = 0x0010;

/// The upper octet n: senders that reduce the update rate of entities with distance multiply
/// distances to this peer by 2^(n / 16). A peer can thus limit the traffic that it receives. 0:
/// unchanged.
inline constexpr std::uint16_t kPresenceStretch = 0xFF00;

/// `scene_peer` of a peer that has no number yet and will take one within seconds.
inline constexpr std::uint8_t kScenePeerWanted = 255;

/// A value of a chain of one-way functions.
using ChainLink = std::array<std::uint8_t, 16>;
/// A message authentication code. Its key is revealed within seconds, so it is short.
using AddressMac = std::array<std::uint8_t, 8>;

struct Presence {
  static constexpr PduType kPduType = PduType::presence;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Presence";

  PduHeader header = header_of<Presence>();
  SimulationAddress simulation;  ///< site and application
  std::uint32_t epoch = 0;       ///< a new random number at every start of the process
  std::uint16_t pool_size = 0;   ///< multicast groups after the base group
  std::uint16_t port = 3000;     ///< UDP port of all groups
  std::uint64_t scene_hash = 0;  ///< peers with another hash are reported and not joined
  std::uint64_t send_time = 0;   ///< UTC since 1970 [ns]
  /// The base group: an IPv6 address, or an IPv4 one as ::ffff:a.b.c.d.
  std::array<std::uint8_t, 16> base_group{};
  CellScheme cell_scheme = CellScheme::none;
  /// Number of the peer in the scene, from 1: it selects the peer's devices, entities and operator.
  std::uint8_t scene_peer = 0;  ///< 0: none; 255: not known yet
  std::uint16_t flags = 0;      ///< kPresence...; unknown bits are ignored
  float cell_size =
      0.0F;  ///< side of a square, or centre to corner of a hexagon; else of the smallest cell [m]
  WorldCoordinates scene_origin;  ///< origin of the scene frame S [m]
  float interest_radius = 0.0F;   ///< sensing range of this peer's entities [m]
  /// UTC second of the start of the process. If two newcomers claim an address, the one that
  /// started earlier keeps it.
  std::uint32_t started = 0;
  std::array<char, 16> name{};  ///< short name for users, padded with NUL
  /// Number of the link that this announcement reveals: 16 for each second since the epoch's first
  /// announcement (its slot), and the number of earlier announcements of that slot. The one-way
  /// function of a link is the previous link. All zero: no proof.
  std::uint32_t chain_number = 0;
  std::uint32_t slot_time = 0;  ///< since the start of the slot [us]
  ChainLink chain_link{};
  ChainLink next_anchor{};  ///< the one-way function of the first of the next 4,096 links
  /// Binds the announcement to its source address, with a key that the first link of the next slot
  /// reveals. All zero: the source address is unknown to the sender.
  AddressMac address_mac{};

  /// The characters of `name` before the first NUL.
  [[nodiscard]] constexpr std::string_view name_view() const noexcept {
    const std::string_view all(name.data(), name.size());
    return all.substr(0, all.find('\0'));
  }
  /// Sets `name`, truncated to 16 characters.
  constexpr void set_name(std::string_view value) noexcept {
    for (std::size_t i = 0; i < name.size(); ++i) name[i] = i < value.size() ? value[i] : '\0';
  }
};

constexpr void fields(auto& visitor, Is<Presence> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("epoch", pdu.epoch);
  visitor("pool_size", pdu.pool_size);
  visitor("port", pdu.port);
  visitor("scene_hash", pdu.scene_hash);
  visitor("send_time", pdu.send_time);
  visitor("base_group", pdu.base_group);
  visitor("cell_scheme", pdu.cell_scheme);
  visitor("scene_peer", pdu.scene_peer);
  visitor("flags", pdu.flags);
  visitor("cell_size", pdu.cell_size);
  visitor("scene_origin", pdu.scene_origin);
  visitor("interest_radius", pdu.interest_radius);
  visitor("started", pdu.started);
  visitor("name", pdu.name);
  visitor("chain_number", pdu.chain_number);
  visitor("slot_time", pdu.slot_time);
  visitor("chain_link", pdu.chain_link);
  visitor("next_anchor", pdu.next_anchor);
  visitor("address_mac", pdu.address_mac);
}
static_assert(kFixedSize<Presence> == 160);

}  // namespace reckon::pdu
