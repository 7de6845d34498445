// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Assured Record (experimental PDU 150): a small record that its sender repeats until each
// addressee has acknowledged it, a mark of such a record, or an acknowledgement.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"

namespace reckon::pdu {

/// Most octets of a record.
inline constexpr std::size_t kMostAssured = 1200;
/// Bit of AssuredRecord::flags in a record: its content is one whole PDU.
inline constexpr std::uint8_t kAssuredPdu = 1;
/// The record is sent once, without acknowledgement; its sequence has no meaning.
inline constexpr std::uint8_t kAssuredOnce = 2;
/// In a record with a PDU and in its mark: receivers deliver it after the earlier records of its
/// sender with this bit.
inline constexpr std::uint8_t kAssuredOrdered = 4;

struct AssuredRecord {
  static constexpr PduType kPduType = PduType::assured_record;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Assured Record";
  using Addressees = Records<PeerEpoch, std::uint16_t>;

  PduHeader header = header_of<AssuredRecord>();
  SimulationAddress simulation;  ///< of the sender
  AssuredKind kind = AssuredKind::none;
  std::uint8_t flags = 0;  ///< kAssuredPdu, kAssuredOnce, kAssuredOrdered
  /// Sequence of this record minus that of its predecessor; 0: none. A receiver delivers the
  /// predecessor first, if that is for it too.
  std::uint16_t predecessor_distance = 0;
  std::uint32_t epoch = 0;     ///< of the sender, as in its trailers
  std::uint32_t sequence = 0;  ///< of the record; in an acknowledgement the highest received
  OctetBlock<std::uint16_t> content;
  std::span<const std::byte>
      addressees;  ///< 4 n octets, read with records_of<PeerEpoch>; none: all
};

constexpr void fields(auto& visitor, Is<AssuredRecord> auto& pdu) {
  visitor("header", pdu.header);
  visitor("simulation_address", pdu.simulation);
  visitor("kind", pdu.kind);
  visitor("flags", pdu.flags);
  visitor("predecessor_distance", pdu.predecessor_distance);
  visitor("epoch", pdu.epoch);
  visitor("sequence", pdu.sequence);
  visitor.count("number_of_addressees", pdu.addressees, AssuredRecord::Addressees{});
  visitor("content_length", pdu.content.count);
  visitor.records("addressees", pdu.addressees, AssuredRecord::Addressees{});
  visitor.walked("content", pdu.content);
}

inline constexpr std::size_t kAssuredRecordSize = 32;  ///< octets, without its variable parts
static_assert(kFixedSize<AssuredRecord> == kAssuredRecordSize);

/// Content of a mark: a PDU of the same datagram is the record of the mark's sequence.
struct AssuredMark {
  std::uint32_t digest = 0;  ///< FNV-1a of the PDU's octets, see assured_digest()
  std::uint16_t length = 0;  ///< of the PDU [octets]
  std::uint16_t padding = 0;
};
static_assert(kFixedSize<AssuredMark> == 8);

/// Content of an acknowledgement. Bit i of octet k is the record `sequence` - (8 k + i).
struct AssuredReceipt {
  std::array<std::uint8_t, 32> received{};
  std::array<std::uint8_t, 32> refused{};  ///< of these, the records that the receiver refused
};
static_assert(kFixedSize<AssuredReceipt> == 64);

/// The 32-bit FNV-1a hash. About 1 ns an octet.
[[nodiscard]] constexpr std::uint32_t assured_digest(std::span<const std::byte> octets) noexcept {
  std::uint32_t hash = 2166136261U;
  for (const std::byte octet : octets)
    hash = (hash ^ static_cast<std::uint32_t>(octet)) * 16777619U;
  return hash;
}

}  // namespace reckon::pdu
