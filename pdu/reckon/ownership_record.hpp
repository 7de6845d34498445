// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Owner of a body of the scene, and the version of that ownership: a record of the Attribute PDU
// (24 octets), in one datagram with the body's Entity State.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

inline constexpr std::uint32_t kOwnershipRecordType = 0x48415004;  ///< "HAP", 4
inline constexpr std::uint16_t kOwnershipRecordLength = 24;        ///< octets

/// The entity ID of a body names no owner, so its states carry this record.
struct OwnershipRecord {
  static constexpr std::uint32_t kType = kOwnershipRecordType;
  static constexpr std::uint16_t kLength = kOwnershipRecordLength;

  std::uint32_t type = kType;
  std::uint16_t length = kLength;
  std::uint8_t flags = 0;  ///< no bit is defined: sent as 0, ignored on reception
  std::uint8_t padding = 0;
  std::uint32_t owner = 0;    ///< epoch of the owner
  std::uint32_t world = 0;    ///< part of the scene; 0: the scene is not divided
  std::uint64_t version = 0;  ///< increases with each change of the owner
};

constexpr void fields(auto& visitor, Is<OwnershipRecord> auto& record) {
  visitor("record_type", record.type);
  visitor("record_length", record.length);
  visitor("flags", record.flags);
  visitor("padding", record.padding);
  visitor("owner", record.owner);
  visitor("world", record.world);
  visitor("version", record.version);
}

static_assert(kFixedSize<OwnershipRecord> == kOwnershipRecordLength);

}  // namespace reckon::pdu
