// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity State PDU (type 1, IEEE 1278.1-2012 7.2.2): type, place and motion of an entity.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"

namespace reckon::pdu {

inline constexpr std::uint32_t kAppearanceFrozen = 1U << 21;       ///< not to be dead-reckoned
inline constexpr std::uint32_t kAppearanceDeactivated = 1U << 23;  ///< leaves the exercise

struct DeadReckoningParameters {
  DeadReckoningAlgorithm algorithm = DeadReckoningAlgorithm::static_;
  std::array<std::uint8_t, 15> other_parameters{};
  Vector3Float linear_acceleration;  ///< world axes for DRM 2 to 5, body axes for 6 to 9 [m/s^2]
  Vector3Float angular_velocity;     ///< body axes [rad/s]
};

/// Up to 11 characters, padded with NUL.
struct EntityMarking {
  MarkingCharacterSet character_set = MarkingCharacterSet::ascii;
  std::array<char, 11> text{};

  /// The characters before the first NUL.
  [[nodiscard]] constexpr std::string_view view() const noexcept {
    const std::string_view all(text.data(), text.size());
    return all.substr(0, all.find('\0'));
  }
  /// Sets ASCII text, truncated to 11 characters.
  constexpr void set(std::string_view value) noexcept {
    character_set = MarkingCharacterSet::ascii;
    for (std::size_t i = 0; i < text.size(); ++i) text[i] = i < value.size() ? value[i] : '\0';
  }
};

struct EntityState {
  static constexpr PduType kPduType = PduType::entity_state;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_information_interaction;
  using VariableParameters = Records<VariableParameter, std::uint8_t>;

  PduHeader header = header_of<EntityState>();
  EntityId entity_id;
  ForceId force_id = ForceId::other;
  EntityType entity_type;
  EntityType alternative_entity_type;
  Vector3Float linear_velocity;  ///< world axes for DRM 1 to 5, body axes for 6 to 9 [m/s]
  WorldCoordinates location;     ///< [m]
  EulerAngles orientation;       ///< [rad]
  std::uint32_t appearance = 0;
  DeadReckoningParameters dead_reckoning;
  EntityMarking marking;
  std::uint32_t capabilities = 0;
  /// 16 n octets, n <= 255; a view into the datagram, or into the caller's octets when encoding.
  std::span<const std::byte> variable_parameters;
};

constexpr void fields(auto& visitor, Is<DeadReckoningParameters> auto& record) {
  visitor("dead_reckoning_algorithm", record.algorithm);
  visitor("other_parameters", record.other_parameters);
  visitor("entity_linear_acceleration", record.linear_acceleration);
  visitor("entity_angular_velocity", record.angular_velocity);
}

constexpr void fields(auto& visitor, Is<EntityMarking> auto& record) {
  visitor("entity_marking_character_set", record.character_set);
  visitor("entity_marking_string", record.text);
}

constexpr void fields(auto& visitor, Is<EntityState> auto& pdu) {
  visitor("header", pdu.header);
  visitor("entity_id", pdu.entity_id);
  visitor("force_id", pdu.force_id);
  visitor.count("number_of_variable_parameter_records", pdu.variable_parameters,
                EntityState::VariableParameters{});
  visitor("entity_type", pdu.entity_type);
  visitor("alternate_entity_type", pdu.alternative_entity_type);
  visitor("entity_linear_velocity", pdu.linear_velocity);
  visitor("entity_location", pdu.location);
  visitor("entity_orientation", pdu.orientation);
  visitor("entity_appearance", pdu.appearance);
  visitor("dead_reckoning_parameters", pdu.dead_reckoning);
  visitor("entity_marking", pdu.marking);
  visitor("capabilities", pdu.capabilities);
  visitor.records("variable_parameters", pdu.variable_parameters,
                  EntityState::VariableParameters{});
}

}  // namespace reckon::pdu
