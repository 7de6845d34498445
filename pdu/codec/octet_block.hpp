// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Variable parts that stay octets: a block whose length is in the fixed part, and the rest of a PDU
// whose layout depends on its content. Views for `visitor.walked`; printed in hexadecimal.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/field_table.hpp"

namespace reckon::pdu {

/// `count` octets.
template <typename CountType>
struct OctetBlock {
  static constexpr std::string_view kUnit = "octets";  ///< unit of the count
  CountType count = 0;
  std::span<const std::byte> bytes;

  /// A block with the count of its own octets.
  [[nodiscard]] static OctetBlock of(std::span<const std::byte> octets) noexcept {
    return {static_cast<CountType>(octets.size()), octets};
  }
  [[nodiscard]] static WalkResult walk(std::size_t count,
                                       std::span<const std::byte> octets) noexcept {
    if (count > octets.size()) return {0, DecodeError::count};
    return {count, DecodeError::none};
  }
  [[nodiscard]] std::span<const std::byte> value() const noexcept { return bytes; }
};

/// `count` bits in whole octets, padded to a multiple of 4 octets (the padding may be missing at
/// the end of the PDU).
struct BitBlock {
  static constexpr std::string_view kUnit = "bits";  ///< unit of the count
  std::uint16_t count = 0;
  std::span<const std::byte> bytes;  ///< including the padding

  [[nodiscard]] static WalkResult walk(std::size_t count,
                                       std::span<const std::byte> octets) noexcept {
    const std::size_t held = (count + 7) / 8;
    if (held > octets.size()) return {0, DecodeError::count};
    return {std::min((held + 3) / 4 * 4, octets.size()), DecodeError::none};
  }
  /// The octets of the bits, without the padding.
  [[nodiscard]] std::span<const std::byte> value() const noexcept {
    return bytes.first(std::min((std::size_t{count} + 7) / 8, bytes.size()));
  }
};

/// All octets up to the end of the PDU, unchanged.
struct RestOfPdu {
  static constexpr std::string_view kUnit = "octets";
  static constexpr std::size_t count = 0;
  std::span<const std::byte> bytes;

  [[nodiscard]] static WalkResult walk(std::size_t, std::span<const std::byte> octets) noexcept {
    return {octets.size(), DecodeError::none};
  }
  [[nodiscard]] std::span<const std::byte> value() const noexcept { return bytes; }
};

/// A view that is printed as octets.
template <typename View>
concept OctetView = requires(const View& view) {
  { view.value() } -> std::same_as<std::span<const std::byte>>;
};

/// Shows the fields of the `Record` at the start of a body, then any further octets. A body that is
/// too short for the record is shown as octets named "body".
template <typename Record, typename Visitor>
void show_as(Visitor& visitor, std::span<const std::byte> body) {
  Record record;
  if (!load_record(body, record)) return visitor.walked("body", RestOfPdu{body});
  fields(visitor, std::as_const(record));
  const std::span<const std::byte> behind = body.subspan(kFixedSize<Record>);
  if (!behind.empty()) visitor.walked("further_octets", RestOfPdu{behind});
}

/// Shows a block as a `Record` if it has the size of one. Otherwise returns false and does nothing.
template <typename Record, typename Visitor, typename View>
bool block_as(Visitor& visitor, std::string_view name, const View& block) {
  if (block.bytes.size() != kFixedSize<Record>) return false;
  Record record;
  if (!load_record(block.bytes, record)) return false;
  visitor(name, std::as_const(record));
  return true;
}

}  // namespace reckon::pdu
