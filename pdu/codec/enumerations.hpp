// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Enumerations of SISO-REF-010 for the PDUs here, with its names (reprinted with permission from
// SISO Inc.), and our own values in the experimental ranges. Any octet value is kept: a received
// enumeration may have a value without a name.
#pragma once

#include <cstdint>
#include <string_view>

namespace reckon::pdu {

/// UID 4: the 72 PDU types of IEEE 1278.1-2012, and ours (129 to 255 are experimental by common
/// use). type_names.hpp has their names.
enum class PduType : std::uint8_t {
  other = 0,
  entity_state = 1,
  fire = 2,
  detonation = 3,
  collision = 4,
  service_request = 5,
  resupply_offer = 6,
  resupply_received = 7,
  resupply_cancel = 8,
  repair_complete = 9,
  repair_response = 10,
  create_entity = 11,
  remove_entity = 12,
  start_resume = 13,
  stop_freeze = 14,
  acknowledge = 15,
  action_request = 16,
  action_response = 17,
  data_query = 18,
  set_data = 19,
  data = 20,
  event_report = 21,
  comment = 22,
  electromagnetic_emission = 23,
  designator = 24,
  transmitter = 25,
  signal = 26,
  receiver = 27,
  iff = 28,
  underwater_acoustic = 29,
  supplemental_emission_entity_state = 30,
  intercom_signal = 31,
  intercom_control = 32,
  aggregate_state = 33,
  is_group_of = 34,
  transfer_ownership = 35,
  is_part_of = 36,
  minefield_state = 37,
  minefield_query = 38,
  minefield_data = 39,
  minefield_response_nack = 40,
  environmental_process = 41,
  gridded_data = 42,
  point_object_state = 43,
  linear_object_state = 44,
  areal_object_state = 45,
  tspi = 46,
  appearance = 47,
  articulated_parts = 48,
  le_fire = 49,
  le_detonation = 50,
  create_entity_r = 51,
  remove_entity_r = 52,
  start_resume_r = 53,
  stop_freeze_r = 54,
  acknowledge_r = 55,
  action_request_r = 56,
  action_response_r = 57,
  data_query_r = 58,
  set_data_r = 59,
  data_r = 60,
  event_report_r = 61,
  comment_r = 62,
  record_r = 63,
  set_record_r = 64,
  record_query_r = 65,
  collision_elastic = 66,
  entity_state_update = 67,
  directed_energy_fire = 68,
  entity_damage_status = 69,
  information_operations_action = 70,
  information_operations_report = 71,
  attribute = 72,
  presence = 140,
  datagram_trailer = 141,
  cell_membership = 142,
  time_exchange = 143,
  peers_heard = 144,
  cell_roles = 145,
  group_map = 146,
  cell_snapshot = 147,
  unicast_frame = 148,
  compressed_states = 149,
  assured_record = 150,
};

/// UID 5. Experimental PDUs of this project have family 129.
enum class ProtocolFamily : std::uint8_t {
  other = 0,
  entity_information_interaction = 1,
  warfare = 2,
  logistics = 3,
  radio_communications = 4,
  simulation_management = 5,
  distributed_emission_regeneration = 6,
  entity_management = 7,
  minefield = 8,
  synthetic_environment = 9,
  simulation_management_with_reliability = 10,
  live_entity = 11,
  non_real_time = 12,
  information_operations = 13,
  experimental = 129,
};

/// UID 44. F/R: rotation ignored/extrapolated; P/V: velocity/acceleration; W/B: world/body axes.
enum class DeadReckoningAlgorithm : std::uint8_t {
  other = 0,
  static_ = 1,
  fpw = 2,
  rpw = 3,
  rvw = 4,
  fvw = 5,
  fpb = 6,
  rpb = 7,
  rvb = 8,
  fvb = 9,
};

/// UID 7.
enum class EntityKind : std::uint8_t {
  other = 0,
  platform = 1,
  munition = 2,
  life_form = 3,
  environmental = 4,
  cultural_feature = 5,
  supply = 6,
  radio = 7,
  expendable = 8,
  sensor_emitter = 9,
};

/// UID 8, for platforms; other kinds use the same octet in their own way.
enum class EntityDomain : std::uint8_t {
  other = 0,
  land = 1,
  air = 2,
  surface = 3,
  subsurface = 4,
  space = 5,
};

/// UID 6; further friendly, opposing and neutral forces follow up to 30.
enum class ForceId : std::uint8_t { other = 0, friendly = 1, opposing = 2, neutral = 3 };

/// UID 45.
enum class MarkingCharacterSet : std::uint8_t {
  unused = 0,
  ascii = 1,
  army_marking = 2,
  digit_chevron = 3,
};

/// UID 56.
enum class VariableParameterType : std::uint8_t {
  articulated_part = 0,
  attached_part = 1,
  separation = 2,
  entity_type = 3,
  entity_association = 4,
};

/// UID 189.
enum class CollisionType : std::uint8_t { inelastic = 0, elastic = 1, boom_nozzle_cleared = 55 };

/// UID 67.
enum class StopFreezeReason : std::uint8_t {
  other = 0,
  recess = 1,
  termination = 2,
  system_failure = 3,
  security_violation = 4,
  entity_reconstitution = 5,
  stop_for_reset = 6,
  stop_for_restart = 7,
  abort_training = 8,
};

/// UID 69.
enum class AcknowledgeFlag : std::uint16_t {
  create_entity = 1,
  remove_entity = 2,
  start_resume = 3,
  stop_freeze = 4,
  transfer_ownership = 5,
};

/// UID 70.
enum class ResponseFlag : std::uint16_t {
  other = 0,
  able_to_comply = 1,
  unable_to_comply = 2,
  pending_operator_action = 3,
};

/// UID 295.
enum class AttributeActionCode : std::uint8_t { no_statement = 0 };

/// Kind of force model in a HapticRecord (ours).
enum class ForceModelKind : std::uint8_t {
  none = 0,
  plane = 1,
  sphere = 2,
  field = 3,
  spring_damper_region = 4,
  modal = 5,
};

/// Division of a scene into cells (ours, in Presence).
enum class CellScheme : std::uint8_t {
  none = 0,
  square = 1,
  hexagonal = 2,
  quad_tree = 3,
  locales = 4
};

/// Form of the Entity States in a Compressed States PDU (ours).
enum class CompressedForm : std::uint8_t { none = 0, compact = 1, residual = 3 };

/// Action of a CellMembership PDU (ours).
enum class MembershipAction : std::uint8_t {
  none = 0,
  join = 1,
  leave = 2,
  lead = 3,
  resign = 4,
  join_near = 5,  ///< a near group of the cells, of the stated row
};

/// What an AssuredRecord PDU is (ours). Other values from 16 on are records of further users.
enum class AssuredKind : std::uint8_t {
  none = 0,
  record = 1,           ///< its content is the record
  mark = 2,             ///< a PDU of the same datagram is the record
  acknowledgement = 3,  ///< the last records that the sender of this PDU has received
  ownership_round = 16,
  ownership_proposal = 17,
  ownership_vote = 18,
  ownership_table = 19,
  ownership_agreement = 20,
  shared_record = 24,   ///< the latest version of one key of the shared records
  record_serials = 25,  ///< what its sender has of each writer
  record_request = 26,  ///< what its sender lacks
  object_query = 32,    ///< which objects make the scene with this hash?
  object_offer = 33,    ///< the object that lists them
  object_request = 34,  ///< chunks that its sender lacks
  object_status = 35,   ///< the last serial of a server, and how many chunks it will send
  object_chunk = 36,
};

/// 129 to 255: experimental by common use; these come last in a bundle.
[[nodiscard]] constexpr bool is_experimental(PduType type) noexcept {
  return static_cast<std::uint8_t>(type) >= 129;
}

/// Names as in the SISO document; "" if the value has none.
[[nodiscard]] std::string_view name(ProtocolFamily value) noexcept;
[[nodiscard]] std::string_view name(DeadReckoningAlgorithm value) noexcept;
[[nodiscard]] std::string_view name(EntityKind value) noexcept;
[[nodiscard]] std::string_view name(ForceId value) noexcept;
[[nodiscard]] std::string_view name(MarkingCharacterSet value) noexcept;
[[nodiscard]] std::string_view name(VariableParameterType value) noexcept;
[[nodiscard]] std::string_view name(CollisionType value) noexcept;
[[nodiscard]] std::string_view name(StopFreezeReason value) noexcept;
[[nodiscard]] std::string_view name(AcknowledgeFlag value) noexcept;
[[nodiscard]] std::string_view name(ResponseFlag value) noexcept;
[[nodiscard]] std::string_view name(AttributeActionCode value) noexcept;
[[nodiscard]] std::string_view name(ForceModelKind value) noexcept;
[[nodiscard]] std::string_view name(CellScheme value) noexcept;
[[nodiscard]] std::string_view name(CompressedForm value) noexcept;
[[nodiscard]] std::string_view name(MembershipAction value) noexcept;
[[nodiscard]] std::string_view name(AssuredKind value) noexcept;
/// The octet of EntityType is a platform domain only if the kind is a platform.
[[nodiscard]] std::string_view name(EntityDomain value) noexcept;

}  // namespace reckon::pdu
