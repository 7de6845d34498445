// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Designator PDU (type 24): a laser or other designator and its spot.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct Designator {
  static constexpr PduType kPduType = PduType::designator;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::distributed_emission_regeneration;

  PduHeader header = header_of<Designator>();
  EntityId designating_entity_id;
  std::uint16_t code_name = 0;
  EntityId designated_entity_id;
  std::uint16_t designator_code = 0;
  float designator_power = 0.0F;                                   ///< [W]
  float designator_wavelength = 0.0F;                              ///< [um]
  Vector3Float designator_spot_with_respect_to_designated_entity;  ///< body axes of that entity [m]
  WorldCoordinates designator_spot_location;                       ///< [m]
  DeadReckoningAlgorithm spot_dead_reckoning_algorithm = DeadReckoningAlgorithm::static_;
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  Vector3Float spot_linear_acceleration;  ///< world axes [m/s^2]
};

constexpr void fields(auto& visitor, Is<Designator> auto& pdu) {
  visitor("header", pdu.header);
  visitor("designating_entity_id", pdu.designating_entity_id);
  visitor("code_name", pdu.code_name);
  visitor("designated_entity_id", pdu.designated_entity_id);
  visitor("designator_code", pdu.designator_code);
  visitor("designator_power", pdu.designator_power);
  visitor("designator_wavelength", pdu.designator_wavelength);
  visitor("designator_spot_with_respect_to_designated_entity",
          pdu.designator_spot_with_respect_to_designated_entity);
  visitor("designator_spot_location", pdu.designator_spot_location);
  visitor("spot_dead_reckoning_algorithm", pdu.spot_dead_reckoning_algorithm);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor("spot_linear_acceleration", pdu.spot_linear_acceleration);
}
static_assert(kFixedSize<Designator> == 88);

}  // namespace reckon::pdu
