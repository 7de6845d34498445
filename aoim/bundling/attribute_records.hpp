// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Encoded records of an Attribute PDU, one after another, in the form that the aggregator merges.
#pragma once

#include <cstddef>
#include <span>

namespace reckon::aoim {

/// Splits the first record off `rest`. Empty if the rest does not begin with a whole record whose
/// length is a multiple of 8 octets; then `rest` stays as it is.
[[nodiscard]] std::span<const std::byte> take_record(std::span<const std::byte>& rest) noexcept;

/// True if the octets are whole records, or none.
[[nodiscard]] bool are_records(std::span<const std::byte> octets) noexcept;

/// True if one of `records` replaces `old`: same type and, for an energy account, same counterpart.
/// All must be whole records.
[[nodiscard]] bool has_successor(std::span<const std::byte> old,
                                 std::span<const std::byte> records) noexcept;

}  // namespace reckon::aoim
