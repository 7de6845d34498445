// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Supplemental Emission / Entity State PDU (type 30): infrared, acoustic and radar signature of an
// entity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Power and speed of one engine.
struct PropulsionSystem {
  float power_setting = 0.0F;
  float engine_rpm = 0.0F;  ///< [1/min]
};

/// Direction of one nozzle.
struct VectoringNozzleSystem {
  float horizontal_deflection_angle = 0.0F;  ///< [deg]
  float vertical_deflection_angle = 0.0F;    ///< [deg]
};

struct SupplementalEmissionEntityState {
  static constexpr PduType kPduType = PduType::supplemental_emission_entity_state;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::distributed_emission_regeneration;
  using PropulsionSystems = Records<PropulsionSystem, std::uint16_t>;
  using VectoringNozzleSystems = Records<VectoringNozzleSystem, std::uint16_t>;

  PduHeader header = header_of<SupplementalEmissionEntityState>();
  EntityId originating_entity_id;
  std::uint16_t infrared_signature_representation_index = 0;
  std::uint16_t acoustic_signature_representation_index = 0;
  std::uint16_t radar_cross_section_signature_representation_index = 0;
  std::span<const std::byte> propulsion_systems;  ///< read with records_of<PropulsionSystem>
  std::span<const std::byte>
      vectoring_nozzle_systems;  ///< read with records_of<VectoringNozzleSystem>
};

constexpr void fields(auto& visitor, Is<SupplementalEmissionEntityState> auto& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("infrared_signature_representation_index", pdu.infrared_signature_representation_index);
  visitor("acoustic_signature_representation_index", pdu.acoustic_signature_representation_index);
  visitor("radar_cross_section_signature_representation_index",
          pdu.radar_cross_section_signature_representation_index);
  visitor.count("number_of_propulsion_systems", pdu.propulsion_systems,
                SupplementalEmissionEntityState::PropulsionSystems{});
  visitor.count("number_of_vectoring_nozzle_systems", pdu.vectoring_nozzle_systems,
                SupplementalEmissionEntityState::VectoringNozzleSystems{});
  visitor.records("propulsion_systems", pdu.propulsion_systems,
                  SupplementalEmissionEntityState::PropulsionSystems{});
  visitor.records("vectoring_nozzle_systems", pdu.vectoring_nozzle_systems,
                  SupplementalEmissionEntityState::VectoringNozzleSystems{});
}
static_assert(kFixedSize<SupplementalEmissionEntityState> == 28);

}  // namespace reckon::pdu
