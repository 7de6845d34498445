// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Environmental Process PDU (type 41): weather, smoke or a plume, as geometry and state records.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/sized_records.hpp"

namespace reckon::pdu {

/// Head of a geometry or state record (UID 250).
struct EnvironmentRecord {
  std::uint32_t record_type = 0;
  /// Head and body, without the padding behind them [bit].
  std::uint16_t record_length = 0;
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

constexpr void fields(auto& visitor, Is<EnvironmentRecord> auto& record) {
  visitor("record_type", record.record_type);
  visitor("record_length", record.record_length);
  visitor("record_index", record.record_index);
  visitor("padding", record.padding);
}
static_assert(kFixedSize<EnvironmentRecord> == 8);

/// Type 65536.
struct BoundingSphere {
  WorldCoordinates center;  ///< [m]
  float radius = 0.0F;      ///< [m]
  std::uint32_t padding = 0;
};

constexpr void fields(auto& visitor, Is<BoundingSphere> auto& record) {
  visitor("center", record.center);
  visitor("radius", record.radius);
  visitor("geometry_padding", record.padding);
}
static_assert(kFixedSize<BoundingSphere> == 32);

/// Type 655360, "point record 1".
struct PointGeometry {
  WorldCoordinates location;  ///< [m]
};
static_assert(kFixedSize<PointGeometry> == 24);

/// Type 786432, "line record 1".
struct LineGeometry {
  WorldCoordinates start;  ///< [m]
  WorldCoordinates end;    ///< [m]
};
static_assert(kFixedSize<LineGeometry> == 48);

/// Type 1048576, "ellipsoid record 1".
struct EllipsoidGeometry {
  WorldCoordinates center;  ///< [m]
  Vector3Float sigma;       ///< [m]
  EulerAngles orientation;  ///< [rad]
};
static_assert(kFixedSize<EllipsoidGeometry> == 48);

/// Type 5242880, "rectangular volume record 1".
struct BoxGeometry {
  WorldCoordinates corner;  ///< [m]
  Vector3Float lengths;     ///< [m]
  EulerAngles orientation;  ///< [rad]
};
static_assert(kFixedSize<BoxGeometry> == 48);

/// Shows the geometries of recorded traffic by their fields. Other geometries, and state records
/// defined by a product, stay octets.
void parts(auto& visitor, const EnvironmentRecord& record, std::span<const std::byte> body) {
  switch (record.record_type) {
    case 65536:
      return show_as<BoundingSphere>(visitor, body);
    case 655360:
      return show_as<PointGeometry>(visitor, body);
    case 786432:
      return show_as<LineGeometry>(visitor, body);
    case 1048576:
      return show_as<EllipsoidGeometry>(visitor, body);
    case 5242880:
      return show_as<BoxGeometry>(visitor, body);
    default:
      return visitor.walked("body", RestOfPdu{body});
  }
}

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

constexpr void fields(auto& visitor, Is<EnvironmentalProcess> auto& pdu) {
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
