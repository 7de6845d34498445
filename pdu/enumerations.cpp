// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "pdu/enumerations.hpp"

#include <array>
#include <cstddef>
#include <string_view>

namespace reckon::pdu {
namespace {

struct TypeName {
  std::uint8_t type;
  std::string_view name;
  std::string_view snake;
};

constexpr TypeName kTypeNames[] = {
    {0, "Other", "other"},
    {1, "Entity State", "entity_state"},
    {2, "Fire", "fire"},
    {3, "Detonation", "detonation"},
    {4, "Collision", "collision"},
    {5, "Service Request", "service_request"},
    {6, "Resupply Offer", "resupply_offer"},
    {7, "Resupply Received", "resupply_received"},
    {8, "Resupply Cancel", "resupply_cancel"},
    {9, "Repair Complete", "repair_complete"},
    {10, "Repair Response", "repair_response"},
    {11, "Create Entity", "create_entity"},
    {12, "Remove Entity", "remove_entity"},
    {13, "Start/Resume", "start_resume"},
    {14, "Stop/Freeze", "stop_freeze"},
    {15, "Acknowledge", "acknowledge"},
    {16, "Action Request", "action_request"},
    {17, "Action Response", "action_response"},
    {18, "Data Query", "data_query"},
    {19, "Set Data", "set_data"},
    {20, "Data", "data"},
    {21, "Event Report", "event_report"},
    {22, "Comment", "comment"},
    {23, "Electromagnetic Emission", "electromagnetic_emission"},
    {24, "Designator", "designator"},
    {25, "Transmitter", "transmitter"},
    {26, "Signal", "signal"},
    {27, "Receiver", "receiver"},
    {28, "IFF", "iff"},
    {29, "Underwater Acoustic", "underwater_acoustic"},
    {30, "Supplemental Emission / Entity State", "supplemental_emission_entity_state"},
    {31, "Intercom Signal", "intercom_signal"},
    {32, "Intercom Control", "intercom_control"},
    {33, "Aggregate State", "aggregate_state"},
    {34, "IsGroupOf", "is_group_of"},
    {35, "Transfer Ownership", "transfer_ownership"},
    {36, "IsPartOf", "is_part_of"},
    {37, "Minefield State", "minefield_state"},
    {38, "Minefield Query", "minefield_query"},
    {39, "Minefield Data", "minefield_data"},
    {40, "Minefield Response NACK", "minefield_response_nack"},
    {41, "Environmental Process", "environmental_process"},
    {42, "Gridded Data", "gridded_data"},
    {43, "Point Object State", "point_object_state"},
    {44, "Linear Object State", "linear_object_state"},
    {45, "Areal Object State", "areal_object_state"},
    {46, "TSPI", "tspi"},
    {47, "Appearance", "appearance"},
    {48, "Articulated Parts", "articulated_parts"},
    {49, "LE Fire", "le_fire"},
    {50, "LE Detonation", "le_detonation"},
    {51, "Create Entity-R", "create_entity_r"},
    {52, "Remove Entity-R", "remove_entity_r"},
    {53, "Start/Resume-R", "start_resume_r"},
    {54, "Stop/Freeze-R", "stop_freeze_r"},
    {55, "Acknowledge-R", "acknowledge_r"},
    {56, "Action Request-R", "action_request_r"},
    {57, "Action Response-R", "action_response_r"},
    {58, "Data Query-R", "data_query_r"},
    {59, "Set Data-R", "set_data_r"},
    {60, "Data-R", "data_r"},
    {61, "Event Report-R", "event_report_r"},
    {62, "Comment-R", "comment_r"},
    {63, "Record-R", "record_r"},
    {64, "Set Record-R", "set_record_r"},
    {65, "Record Query-R", "record_query_r"},
    {66, "Collision-Elastic", "collision_elastic"},
    {67, "Entity State Update", "entity_state_update"},
    {68, "Directed Energy Fire", "directed_energy_fire"},
    {69, "Entity Damage Status", "entity_damage_status"},
    {70, "Information Operations Action", "information_operations_action"},
    {71, "Information Operations Report", "information_operations_report"},
    {72, "Attribute", "attribute"},
    {140, "Presence", "presence"},
    {141, "Datagram Trailer", "datagram_trailer"},
    {142, "Cell Membership", "cell_membership"},
};

constexpr std::size_t kTypes = 256;

constexpr std::array<const TypeName*, kTypes> type_index() {
  std::array<const TypeName*, kTypes> index{};
  for (const TypeName& row : kTypeNames) index[row.type] = &row;
  return index;
}

constexpr std::array<const TypeName*, kTypes> kTypeIndex = type_index();

// "unknown type 200", made while compiling so that naming never allocates.
struct NumberedText {
  std::array<char, 17> text{};
  std::size_t size = 0;

  constexpr void add(char c) { text[size++] = c; }
};

constexpr NumberedText numbered(std::string_view prefix, std::size_t number) {
  NumberedText out;
  for (const char c : prefix) out.add(c);
  if (number >= 100) out.add(static_cast<char>('0' + number / 100));
  if (number >= 10) out.add(static_cast<char>('0' + number / 10 % 10));
  out.add(static_cast<char>('0' + number % 10));
  return out;
}

constexpr std::array<NumberedText, kTypes> numbered_table(std::string_view prefix) {
  std::array<NumberedText, kTypes> table;
  for (std::size_t i = 0; i < kTypes; ++i) table[i] = numbered(prefix, i);
  return table;
}

constexpr std::array<NumberedText, kTypes> kUnknownNames = numbered_table("unknown type ");
constexpr std::array<NumberedText, kTypes> kUnknownSnakeNames = numbered_table("unknown_");

constexpr std::string_view text(const NumberedText& entry) {
  return {entry.text.data(), entry.size};
}

template <typename Enumeration, std::size_t size>
constexpr std::string_view from(const std::array<std::string_view, size>& names,
                                Enumeration value) {
  const auto i = static_cast<std::size_t>(value);
  return i < size ? names[i] : std::string_view();
}

template <typename... Text>
constexpr auto list(Text... text) {
  return std::array<std::string_view, sizeof...(Text)>{text...};
}

constexpr auto kFamilies =
    list("Other", "Entity Information/Interaction", "Warfare", "Logistics", "Radio Communications",
         "Simulation Management", "Distributed Emission Regeneration", "Entity Management",
         "Minefield", "Synthetic Environment", "Simulation Management with Reliability",
         "Live Entity (LE) Information/Interaction", "Non-Real-Time", "Information Operations");
constexpr auto kAlgorithms = list("Other", "Static", "DRM FPW", "DRM RPW", "DRM RVW", "DRM FVW",
                                  "DRM FPB", "DRM RPB", "DRM RVB", "DRM FVB");
constexpr auto kKinds = list("Other", "Platform", "Munition", "Life form", "Environmental",
                             "Cultural feature", "Supply", "Radio", "Expendable", "Sensor/Emitter");
constexpr auto kDomains = list("Other", "Land", "Air", "Surface", "Subsurface", "Space");
constexpr auto kForces =
    list("Other", "Friendly", "Opposing", "Neutral", "Friendly 2", "Opposing 2", "Neutral 2",
         "Friendly 3", "Opposing 3", "Neutral 3", "Friendly 4", "Opposing 4", "Neutral 4",
         "Friendly 5", "Opposing 5", "Neutral 5", "Friendly 6", "Opposing 6", "Neutral 6",
         "Friendly 7", "Opposing 7", "Neutral 7", "Friendly 8", "Opposing 8", "Neutral 8",
         "Friendly 9", "Opposing 9", "Neutral 9", "Friendly 10", "Opposing 10", "Neutral 10");
constexpr auto kCharacterSets = list("Unused", "ASCII", "U.S. Army Marking", "Digit Chevron");
constexpr auto kParameterTypes =
    list("Articulated Part", "Attached Part", "Separation", "Entity Type", "Entity Association");
constexpr auto kReasons = list("Other", "Recess", "Termination", "System Failure",
                               "Security Violation", "Entity Reconstitution", "Stop for reset",
                               "Stop for restart", "Abort Training Return to Tactical Operations");
constexpr auto kAcknowledgeFlags =
    list("", "Create Entity", "Remove Entity", "Start/Resume", "Stop/Freeze", "Transfer Ownership");
constexpr auto kResponseFlags =
    list("Other", "Able to comply", "Unable to comply", "Pending Operator Action");
constexpr auto kActionCodes = list("No Statement");
constexpr auto kForceModels =
    list("None", "Plane", "Sphere", "Field", "Spring-damper region", "Modal");
constexpr auto kCellSchemes = list("None", "Square", "Hexagonal");
constexpr auto kMembershipActions = list("None", "Join", "Leave", "Lead", "Resign");

}  // namespace

std::string_view name(PduType type) noexcept {
  const auto i = static_cast<std::size_t>(type);
  return kTypeIndex[i] != nullptr ? kTypeIndex[i]->name : text(kUnknownNames[i]);
}

std::string_view snake_name(PduType type) noexcept {
  const auto i = static_cast<std::size_t>(type);
  return kTypeIndex[i] != nullptr ? kTypeIndex[i]->snake : text(kUnknownSnakeNames[i]);
}

bool is_named(PduType type) noexcept {
  return kTypeIndex[static_cast<std::size_t>(type)] != nullptr;
}

std::string_view name(ProtocolFamily value) noexcept {
  return value == ProtocolFamily::experimental ? "Experimental" : from(kFamilies, value);
}

std::string_view name(CollisionType value) noexcept {
  if (value == CollisionType::boom_nozzle_cleared) return "Boom nozzle cleared";
  return from(list("Inelastic", "Elastic"), value);
}

std::string_view name(DeadReckoningAlgorithm value) noexcept { return from(kAlgorithms, value); }
std::string_view name(EntityKind value) noexcept { return from(kKinds, value); }
std::string_view name(EntityDomain value) noexcept { return from(kDomains, value); }
std::string_view name(ForceId value) noexcept { return from(kForces, value); }
std::string_view name(MarkingCharacterSet value) noexcept { return from(kCharacterSets, value); }
std::string_view name(VariableParameterType value) noexcept { return from(kParameterTypes, value); }
std::string_view name(StopFreezeReason value) noexcept { return from(kReasons, value); }
std::string_view name(AcknowledgeFlag value) noexcept { return from(kAcknowledgeFlags, value); }
std::string_view name(ResponseFlag value) noexcept { return from(kResponseFlags, value); }
std::string_view name(AttributeActionCode value) noexcept { return from(kActionCodes, value); }
std::string_view name(ForceModelKind value) noexcept { return from(kForceModels, value); }
std::string_view name(CellScheme value) noexcept { return from(kCellSchemes, value); }
std::string_view name(MembershipAction value) noexcept { return from(kMembershipActions, value); }

}  // namespace reckon::pdu
