// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers Heard (experimental PDU 144): the peers from which a peer receives, so that a peer missing
// in the list detects that it is not received. Each peer sends it every second on the base group.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Epoch of a peer.
struct PeerEpoch {
  std::uint32_t epoch = 0;  ///< as in its Presence

  friend constexpr auto operator<=>(const PeerEpoch&, const PeerEpoch&) = default;
};

/// Values of `continues`: the sender also receives peers with epochs below the lowest in the list,
/// or above the highest. The list gives no information about peers in that range.
inline constexpr std::uint16_t kPeersHeardBelow = 0x0001, kPeersHeardAbove = 0x0002;

struct PeersHeard {
  static constexpr PduType kPduType = PduType::peers_heard;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Peers Heard";
  using Epochs = Records<PeerEpoch, std::uint16_t>;

  PduHeader header = header_of<PeersHeard>();
  SimulationAddress simulation;
  std::uint32_t epoch = 0;            ///< of the sender
  std::uint16_t continues = 0;        ///< 0: the list is complete; else kPeersHeard...
  std::span<const std::byte> epochs;  ///< 4 n octets, read with records_of<PeerEpoch>
};

constexpr void fields(auto& visitor, Is<PeersHeard> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("epoch", pdu.epoch);
  visitor.count("number_of_peers", pdu.epochs, PeersHeard::Epochs{});
  visitor("continues", pdu.continues);
  visitor.records("peers", pdu.epochs, PeersHeard::Epochs{});
}
static_assert(kFixedSize<PeersHeard> == 24);

}  // namespace reckon::pdu
