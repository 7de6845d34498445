// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records of several PDUs with a type of SISO-REF-010 (UID 66). Their bodies are kept as octets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "reckon/pdu/codec/sized_records.hpp"

namespace reckon::pdu {

/// Head of a standard variable record: directed energy, damage, information operations, radio.
struct StandardVariableRecord {
  std::uint32_t record_type = 0;
  std::uint16_t record_length = 6;  ///< type, length, body and padding [octets]

  [[nodiscard]] WalkResult extent(std::span<const std::byte>) const noexcept;
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    record_length = static_cast<std::uint16_t>(padded_to(6 + octets, 8));
    return record_length - std::size_t{6};
  }
};

constexpr void fields(auto& visitor, Is<StandardVariableRecord> auto& record) {
  visitor("record_type", record.record_type);
  visitor("record_length", record.record_length);
}

inline WalkResult StandardVariableRecord::extent(std::span<const std::byte>) const noexcept {
  return behind_head(record_length, kFixedSize<StandardVariableRecord>);
}

/// Head of a record set of the reliability family and of Transfer Ownership: `record_count` values
/// of equal size, padded to a multiple of 8 octets.
struct RecordSet {
  std::uint32_t record_id = 0;
  std::uint32_t record_set_serial_number = 0;
  std::uint32_t padding = 0;
  std::uint16_t record_length = 0;  ///< of one value [bit]
  std::uint16_t record_count = 0;

  [[nodiscard]] WalkResult extent(std::span<const std::byte> behind) const noexcept {
    const std::size_t held = (std::size_t{record_length} * record_count + 7) / 8;
    if (held > behind.size()) return {0, DecodeError::record};
    return {std::min(padded_to(held, 8), behind.size()), DecodeError::none};
  }
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    record_length = 64;
    record_count = static_cast<std::uint16_t>(octets / 8);
    return std::size_t{record_count} * 8;
  }
};

constexpr void fields(auto& visitor, Is<RecordSet> auto& record) {
  visitor("record_id", record.record_id);
  visitor("record_set_serial_number", record.record_set_serial_number);
  visitor("padding", record.padding);
  visitor("record_length", record.record_length);
  visitor("record_count", record.record_count);
}
static_assert(kFixedSize<RecordSet> == 16);

}  // namespace reckon::pdu
