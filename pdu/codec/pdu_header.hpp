// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The first 12 octets of every PDU (IEEE 1278.1-2012 6.2.66).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/codec/decode_error.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/codec/field_table.hpp"

namespace reckon::pdu {

inline constexpr std::uint8_t kProtocolVersion = 7;        ///< IEEE 1278.1-2012, for sending
inline constexpr std::uint8_t kOldestProtocolVersion = 5;  ///< IEEE 1278.1-1995, oldest received
inline constexpr std::size_t kHeaderSize = 12;             ///< octets
inline constexpr std::size_t kMaxPduSize = 65535;          ///< octets, limit of the length field

inline constexpr std::uint8_t kStatusTransferredEntity = 0x01;
/// Coupled extension (CEI): an Attribute PDU in the same datagram extends this PDU.
inline constexpr std::uint8_t kStatusCoupledExtension = 0x08;

/// Encoding sets length, pdu_type and protocol_family from the PDU itself.
struct PduHeader {
  std::uint8_t protocol_version = kProtocolVersion;
  std::uint8_t exercise_id = 1;
  PduType pdu_type = PduType::other;
  ProtocolFamily protocol_family = ProtocolFamily::other;
  /// 31 bits of 3600 s / (2^31 - 1), low bit 1 = absolute; see timestamp.hpp.
  std::uint32_t timestamp = 0;
  /// Whole PDU including the header [octets].
  std::uint16_t length = 0;
  std::uint8_t pdu_status = 0;
  std::uint8_t padding = 0;

  [[nodiscard]] constexpr bool coupled_extension() const {
    return (pdu_status & kStatusCoupledExtension) != 0;
  }
  friend constexpr bool operator==(const PduHeader&, const PduHeader&) = default;
};

/// The initial header of a PDU of type Pdu.
template <typename Pdu>
[[nodiscard]] constexpr PduHeader header_of() noexcept {
  PduHeader header;
  header.pdu_type = Pdu::kPduType;
  header.protocol_family = Pdu::kProtocolFamily;
  return header;
}

/// Whether the layout of this version is read here: IEEE 1278.1-1995, 1278.1A-1998 and 1278.1-2012.
[[nodiscard]] constexpr bool is_supported_version(std::uint8_t protocol_version) noexcept {
  return protocol_version >= kOldestProtocolVersion && protocol_version <= kProtocolVersion;
}

/// Whether the version is an older one, in which some fields have another meaning.
[[nodiscard]] constexpr bool is_before_dis7(const PduHeader& header) noexcept {
  return header.protocol_version < 7;
}

/// Checks version and length field against the available octets: truncated, version, length or
/// none.
[[nodiscard]] inline DecodeError check_header(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < kHeaderSize) return DecodeError::truncated;
  if (!is_supported_version(load_big_endian<std::uint8_t>(bytes.data())))
    return DecodeError::version;
  const auto length = load_big_endian<std::uint16_t>(bytes.data() + 8);
  if (length < kHeaderSize) return DecodeError::length;
  return length > bytes.size() ? DecodeError::truncated : DecodeError::none;
}

/// Reads only the header, with the checks of check_header. `out` is filled whenever there are 12
/// octets, whatever the result; otherwise it is reset.
[[nodiscard]] DecodeError decode_header(std::span<const std::byte> bytes, PduHeader& out) noexcept;

}  // namespace reckon::pdu
