// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contents of Assured Records (PDU 150) that keep shared records equal at all peers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::pdu {

/// Most octets of a key and of a value.
inline constexpr std::size_t kMostRecordKey = 63, kMostRecordValue = 1024;

/// One record; its key and its value follow. Without a key it means that no record of the writer
/// is left between the two serials.
struct SharedRecordHead {
  std::uint32_t counter = 0;  ///< of the versions of this key: one more than the version before
  std::uint32_t writer = 0;   ///< epoch; decides between versions of one counter
  std::uint32_t serial = 0;   ///< of the writer's writes, from 1
  /// Serial of the nearest earlier record of this writer that is left; 0: none. The writes between
  /// were replaced by later versions.
  std::uint32_t prior = 0;
  std::uint8_t key_length = 0;
  std::uint8_t padding = 0;
  std::uint16_t value_length = 0;
};
static_assert(kFixedSize<SharedRecordHead> == 20);

/// What the sender has of a writer. A message holds any number.
struct KnownSerial {
  std::uint32_t writer = 0;
  std::uint32_t serial = 0;  ///< all writes up to it are known
  std::uint32_t last = 0;    ///< the last known write
  /// Exclusive or, over the serials s of its records that are left, of p + (p >> 16) mod 2^32, with
  /// p = 2654435761 s mod 2^32. It differs where a record was replaced by one that is lost.
  std::uint32_t digest = 0;
};
static_assert(kFixedSize<KnownSerial> == 16);

/// Writes of a writer that the sender lacks. A message holds any number.
struct MissingSerials {
  std::uint32_t writer = 0;
  std::uint32_t first = 0, last = 0;
};
static_assert(kFixedSize<MissingSerials> == 12);

}  // namespace reckon::pdu
