// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datum records of the simulation management PDUs (IEEE 1278.1-2012 6.2.37, 6.2.93).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/record_range.hpp"

namespace reckon::pdu {

/// 8 octets; the meaning of the value depends on the ID.
struct FixedDatum {
  std::uint32_t datum_id = 0;
  std::uint32_t value = 0;

  friend constexpr bool operator==(const FixedDatum&, const FixedDatum&) = default;
};

constexpr void fields(auto& visitor, Is<FixedDatum> auto& record) {
  visitor("fixed_datum_id", record.datum_id);
  visitor("fixed_datum_value", record.value);
}

/// 4 octets: requested datum of a query.
struct DatumId {
  std::uint32_t datum_id = 0;
};

using FixedDatums = Records<FixedDatum, std::uint32_t>;
using DatumIds = Records<DatumId, std::uint32_t>;

/// One record in the datagram.
struct VariableDatum {
  std::uint32_t datum_id = 0;
  std::uint32_t length_bits = 0;     ///< of the value, without padding
  std::span<const std::byte> value;  ///< the octets that hold these bits
};

/// Iterates over variable datums: 8 octets, the value, padding to a multiple of 8 octets (the last
/// record may lack its padding). The stated length is checked before use, so that a length of 2^32
/// - 1 bits costs nothing.
class VariableDatumCursor {
 public:
  VariableDatumCursor(std::size_t count, std::span<const std::byte> rest) noexcept
      : count_(count), rest_(rest) {}
  /// False at the end and at the first record that does not fit (then error() has the reason).
  [[nodiscard]] bool next(VariableDatum& out) noexcept;
  [[nodiscard]] DecodeError error() const noexcept { return error_; }
  [[nodiscard]] std::span<const std::byte> rest() const noexcept { return rest_; }

 private:
  std::size_t count_;
  std::span<const std::byte> rest_;
  DecodeError error_ = DecodeError::none;
};

/// `count` consecutive variable datums.
struct VariableDatums {
  std::uint32_t count = 0;
  std::span<const std::byte> bytes;

  [[nodiscard]] static WalkResult walk(std::size_t count,
                                       std::span<const std::byte> octets) noexcept;
  /// `for (const VariableDatum& datum : data.variable_datums.records())`
  [[nodiscard]] auto records() const noexcept {
    return CursorRange<VariableDatumCursor, VariableDatum>(VariableDatumCursor(count, bytes));
  }
};

/// The datums at the end of most PDUs of simulation management: both counts, then the records.
constexpr void datum_fields(auto& visitor, auto& pdu) {
  visitor.count("number_of_fixed_datum_records", pdu.fixed_datums, FixedDatums{});
  visitor("number_of_variable_datum_records", pdu.variable_datums.count);
  visitor.records("fixed_datum_records", pdu.fixed_datums, FixedDatums{});
  visitor.walked("variable_datum_records", pdu.variable_datums);
}

/// Builds a block of variable datums in the caller's buffer. A call that returns false has changed
/// nothing.
class VariableDatumWriter {
 public:
  explicit VariableDatumWriter(std::span<std::byte> buffer) noexcept : buffer_(buffer) {}
  /// Adds a datum of whole octets, with its padding.
  [[nodiscard]] bool add(std::uint32_t datum_id, std::span<const std::byte> value) noexcept;
  /// The block so far, to be assigned to a PDU.
  [[nodiscard]] VariableDatums datums() const noexcept { return {count_, buffer_.first(size_)}; }

 private:
  std::span<std::byte> buffer_;
  std::size_t size_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace reckon::pdu
