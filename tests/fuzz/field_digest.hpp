// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One number for all values of a PDU, NaN payloads and padding included: two PDUs with equal
// digests have equal fields. A visitor of the field tables that shares no code with the codec.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/field_table.hpp"

namespace reckon::fuzz {

/// FNV-1a over the octets of every field in the order of the table.
class FieldDigest {
 public:
  template <typename T>
  void operator()(std::string_view, const T& value) noexcept {
    if constexpr (pdu::Scalar<T>) {
      add(std::as_bytes(std::span(&value, 1)));
    } else if constexpr (pdu::kIsStdArray<T>) {
      add(std::as_bytes(std::span(value)));
    } else {
      fields(*this, value);
    }
  }
  template <typename Record, typename Count>
  void count(std::string_view, std::span<const std::byte> view,
             pdu::Records<Record, Count>) noexcept {
    (*this)("", view.size());
  }
  template <typename Record, typename Count>
  void records(std::string_view, std::span<const std::byte> view,
               pdu::Records<Record, Count>) noexcept {
    add(view);
  }
  template <typename View>
  void walked(std::string_view, const View& view) noexcept {
    (*this)("", view.bytes.size());
    add(view.bytes);
  }

  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  void add(std::span<const std::byte> octets) noexcept {
    for (const std::byte octet : octets)
      value_ = (value_ ^ std::to_integer<std::uint64_t>(octet)) * 0x100000001B3U;
  }

  std::uint64_t value_ = 0xCBF29CE484222325U;
};

template <typename Pdu>
[[nodiscard]] std::uint64_t digest(const Pdu& pdu) noexcept {
  FieldDigest digest;
  fields(digest, pdu);
  return digest.value();
}

}  // namespace reckon::fuzz
