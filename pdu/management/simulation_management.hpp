// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of the PDUs of simulation management (types 11 to 22) and their reliable versions
// (51 to 62). A reliable version has the same fields, and states the reliability of the answer.
#pragma once

#include <cstdint>
#include <type_traits>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Types 51 to 65.
[[nodiscard]] constexpr bool is_reliable(PduType type) noexcept {
  return type >= PduType::create_entity_r && type <= PduType::record_query_r;
}

[[nodiscard]] constexpr ProtocolFamily management_family(PduType type) noexcept {
  return is_reliable(type) ? ProtocolFamily::simulation_management_with_reliability
                           : ProtocolFamily::simulation_management;
}

/// Additional fields of a reliable version.
struct ReliabilityService {
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
};

/// The same with one octet of padding: Stop/Freeze-R and the record PDUs.
struct ShortReliabilityService {
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t padding = 0;
};

/// Replacement in the version without reliability: nothing, or four octets of padding.
struct NoService {};

template <typename Visitor, Is<NoService> Record>
constexpr void fields(Visitor&, Record&) {}

struct ServicePadding {
  std::uint32_t padding = 0;
};

/// The service of a reliable version, else `Instead`. Its fields are direct fields of the PDU:
/// `fields(visitor, pdu.reliability)`.
template <PduType type, typename Instead = NoService>
using ServiceOf = std::conditional_t<is_reliable(type), ReliabilityService, Instead>;

/// The header and the IDs at the start of all these PDUs.
constexpr void management_fields(auto& visitor, auto& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
}

}  // namespace reckon::pdu
