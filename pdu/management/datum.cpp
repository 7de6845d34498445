// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/management/datum.hpp"

#include <algorithm>

namespace reckon::pdu {
namespace {

constexpr std::size_t kDatumHeaderSize = 8;  // id and length

constexpr std::size_t padded(std::size_t octets) noexcept { return (octets + 7) / 8 * 8; }

}  // namespace

bool VariableDatumCursor::next(VariableDatum& out) noexcept {
  if (count_ == 0) return false;
  if (rest_.size() < kDatumHeaderSize) {
    error_ = DecodeError::count;
    return false;
  }
  out.datum_id = load_big_endian<std::uint32_t>(rest_.data());
  out.length_bits = load_big_endian<std::uint32_t>(rest_.data() + 4);

  const std::size_t octets = (std::size_t{out.length_bits} + 7) / 8;
  const std::span<const std::byte> behind = rest_.subspan(kDatumHeaderSize);
  if (octets > behind.size()) {
    error_ = DecodeError::record;
    return false;
  }
  out.value = behind.first(octets);
  rest_ = behind.subspan(std::min(padded(octets), behind.size()));
  --count_;
  return true;
}

WalkResult VariableDatums::walk(std::size_t count, std::span<const std::byte> octets) noexcept {
  VariableDatumCursor cursor(count, octets);
  VariableDatum datum;
  while (cursor.next(datum)) {
  }
  return {octets.size() - cursor.rest().size(), cursor.error()};
}

bool VariableDatumWriter::add(std::uint32_t datum_id, std::span<const std::byte> value) noexcept {
  constexpr std::size_t kMostOctets = 0x1FFFFFFF;  // limit of a 32-bit length in bits
  const std::size_t left = buffer_.size() - size_;
  if (value.size() > kMostOctets || left < kDatumHeaderSize + padded(value.size())) return false;

  std::byte* at = buffer_.data() + size_;
  store_big_endian(at, datum_id);
  store_big_endian(at + 4, static_cast<std::uint32_t>(value.size() * 8));
  std::byte* padding = std::copy(value.begin(), value.end(), at + kDatumHeaderSize);
  std::fill_n(padding, padded(value.size()) - value.size(), std::byte{0});
  size_ += kDatumHeaderSize + padded(value.size());
  ++count_;
  return true;
}

}  // namespace reckon::pdu
