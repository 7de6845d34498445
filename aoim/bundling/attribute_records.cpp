// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/bundling/attribute_records.hpp"

#include <algorithm>
#include <cstring>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/entity/attribute.hpp"

namespace reckon::aoim {
namespace {

// Octets that identify the subject of a record: its type, and for an energy account the
// counterpart.
std::size_t name_size(std::span<const std::byte> record) noexcept {
  const auto type = pdu::load_big_endian<std::uint32_t>(record.data());
  return type == pdu::kEnergyAccountRecordType ? std::min<std::size_t>(12, record.size()) : 4;
}

}  // namespace

std::span<const std::byte> take_record(std::span<const std::byte>& rest) noexcept {
  constexpr std::size_t kHeader = pdu::kAttributeRecordHeaderSize;
  std::size_t length = 0;
  if (rest.size() >= kHeader) length = pdu::load_big_endian<std::uint16_t>(rest.data() + 4);
  if (length < kHeader || length % 8 != 0 || length > rest.size()) length = 0;
  const auto record = rest.first(length);
  rest = rest.subspan(length);
  return record;
}

bool are_records(std::span<const std::byte> octets) noexcept {
  while (!octets.empty()) {
    if (take_record(octets).empty()) return false;
  }
  return true;
}

bool has_successor(std::span<const std::byte> old, std::span<const std::byte> records) noexcept {
  const std::size_t size = name_size(old);
  while (!records.empty()) {
    const auto record = take_record(records);
    if (record.size() >= size && std::memcmp(record.data(), old.data(), 4) == 0 &&
        std::memcmp(record.data() + 6, old.data() + 6, size - std::min<std::size_t>(size, 6)) ==
            0) {
      return true;
    }
  }
  return false;
}

}  // namespace reckon::aoim
