// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Errors of received octets: each has one value, one rule name and one sentence.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace reckon::pdu {

/// Reason why octets are not a valid PDU. `none` is the only success, `unknown_type` is a note, and
/// `not_finite` is a warning that only `examine()` returns. With all others the PDU is rejected.
enum class DecodeError : std::uint8_t {
  none,
  truncated,     ///< fewer octets than the header needs or the length field states
  length,        ///< the length field is smaller than the fixed part of this PDU type
  count,         ///< the record count needs more octets than are left
  record,        ///< a record's own length is too small or runs past the PDU
  version,       ///< a protocol or record version that is not supported
  pdu_type,      ///< the octets are a PDU or record of another type than the caller asked for
  stray,         ///< octets behind the last PDU that are neither padding nor a PDU
  unknown_type,  ///< a PDU type without a field table here: stepped over by its length and kept
  not_finite,    ///< NaN or infinity in a field
};

/// Stable short name for tools and counters: "E-TRUNCATED"; E- error, W- warning, I- note, "" for
/// none.
[[nodiscard]] constexpr std::string_view rule(DecodeError error) noexcept {
  switch (error) {
    case DecodeError::none:
      return "";
    case DecodeError::truncated:
      return "E-TRUNCATED";
    case DecodeError::length:
      return "E-LENGTH";
    case DecodeError::count:
      return "E-COUNT";
    case DecodeError::record:
      return "E-RECORD";
    case DecodeError::version:
      return "E-VERSION";
    case DecodeError::pdu_type:
      return "E-TYPE";
    case DecodeError::stray:
      return "E-STRAY";
    case DecodeError::unknown_type:
      return "I-UNKNOWN-TYPE";
    case DecodeError::not_finite:
      return "W-NOT-FINITE";
  }
  return "E-INTERNAL";
}

/// One English sentence for users.
[[nodiscard]] constexpr std::string_view sentence(DecodeError error) noexcept {
  switch (error) {
    case DecodeError::none:
      return "The PDU is well formed.";
    case DecodeError::truncated:
      return "The datagram ends before the PDU does.";
    case DecodeError::length:
      return "The length field is too small for a PDU of this type.";
    case DecodeError::count:
      return "More records are announced than octets are left in the PDU.";
    case DecodeError::record:
      return "A record's length is too small or runs past the end of the PDU.";
    case DecodeError::version:
      return "The protocol or record version is not supported.";
    case DecodeError::pdu_type:
      return "The octets are of another type than the one asked for.";
    case DecodeError::stray:
      return "Octets behind the last PDU are neither padding nor a PDU.";
    case DecodeError::unknown_type:
      return "No field table for this PDU type: its octets are kept as they are.";
    case DecodeError::not_finite:
      return "A field holds NaN or infinity.";
  }
  return "A value outside the list of decode errors.";
}

/// Number of values, for tables of counters.
inline constexpr std::size_t kDecodeErrors = 10;

}  // namespace reckon::pdu
