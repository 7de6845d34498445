// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Environmental Process PDU (type 41): weather, smoke, a plume: geometry and state records.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"
#include "pdu/sized_records.hpp"

namespace reckon::pdu {

/// Head of a geometry or state record (UID 250); the body is kept as octets.
struct EnvironmentRecord {
  std::uint32_t record_type = 0;
  std::uint16_t record_length =
      0;  ///< head, body, without the padding to a multiple of 8 octets [bit]
  std::uint8_t record_index = 0;
  std::uint8_t padding = 0;

  [[nodiscard]] WalkResult extent(std::span<const std::byte>) const noexcept {
    return behind_head(padded_to((std::size_t{record_length} + 7) / 8, 8), 8);
  }
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    record_length = static_cast<std::uint16_t>(8 * padded_to(8 + octets, 8));
    return record_length / std::size_t{8} - 8;
  }
};

template <typename Visitor, Is<EnvironmentRecord> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("record_type", record.record_type);
  visitor("record_length", record.record_length);
  visitor("record_index", record.record_index);
  visitor("padding", record.padding);
}
static_assert(kFixedSize<EnvironmentRecord> == 8);

struct EnvironmentalProcess {
  static constexpr PduType kPduType = PduType::environmental_process;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::synthetic_environment;

  PduHeader header = header_of<EnvironmentalProcess>();
  EntityId environmental_process_id;
  EntityType environment_type;
  std::uint8_t model_type = 0;
  std::uint8_t environment_status = 0;
  SizedRecords<EnvironmentRecord, std::uint16_t> environment_records;
  std::uint16_t sequence_number = 0;
};

template <typename Visitor, Is<EnvironmentalProcess> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("environmental_process_id", pdu.environmental_process_id);
  visitor("environment_type", pdu.environment_type);
  visitor("model_type", pdu.model_type);
  visitor("environment_status", pdu.environment_status);
  visitor("number_of_environment_records", pdu.environment_records.count);
  visitor("sequence_number", pdu.sequence_number);
  visitor.walked("environment_records", pdu.environment_records);
}
static_assert(kFixedSize<EnvironmentalProcess> == 32);

}  // namespace reckon::pdu
