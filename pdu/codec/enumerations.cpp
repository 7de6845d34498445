// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/codec/enumerations.hpp"

#include <array>
#include <cstddef>
#include <string_view>

#include "reckon/pdu/codec/siso_names.hpp"

namespace reckon::pdu {
namespace {

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

/// An enumeration of SISO-REF-010 with all names in one table.
std::string_view listed(SisoTable table, auto value) {
  return siso_name(table, static_cast<std::uint32_t>(value));
}

constexpr auto kForceModels =
    list("None", "Plane", "Sphere", "Field", "Spring-damper region", "Modal");
constexpr auto kCellSchemes = list("None", "Square", "Hexagonal", "Quad-Tree", "Locales");
constexpr auto kCompressedForms = list("None", "Compact", "Reserved", "Residual");
constexpr auto kMembershipActions = list("None", "Join", "Leave", "Lead", "Resign", "Join Near");
constexpr auto kAssuredKinds =
    list("None", "Record", "Mark", "Acknowledgement", "", "", "", "", "", "", "", "", "", "", "", "",
         "Ownership Round", "Ownership Proposal", "Ownership Vote", "Ownership Table",
         "Ownership Agreement");

}  // namespace

std::string_view name(ProtocolFamily value) noexcept {
  return listed(SisoTable::protocol_family, value);
}
std::string_view name(DeadReckoningAlgorithm value) noexcept {
  return listed(SisoTable::dead_reckoning_algorithm, value);
}
std::string_view name(EntityKind value) noexcept { return listed(SisoTable::entity_kind, value); }
std::string_view name(EntityDomain value) noexcept {
  return listed(SisoTable::platform_domain, value);
}
std::string_view name(ForceId value) noexcept { return listed(SisoTable::force_id, value); }
std::string_view name(MarkingCharacterSet value) noexcept {
  return listed(SisoTable::marking_character_set, value);
}
std::string_view name(VariableParameterType value) noexcept {
  return listed(SisoTable::variable_parameter_type, value);
}
std::string_view name(CollisionType value) noexcept {
  return listed(SisoTable::collision_type, value);
}
std::string_view name(StopFreezeReason value) noexcept {
  return listed(SisoTable::stop_freeze_reason, value);
}
std::string_view name(AcknowledgeFlag value) noexcept {
  return listed(SisoTable::acknowledge_flag, value);
}
std::string_view name(ResponseFlag value) noexcept {
  return listed(SisoTable::response_flag, value);
}
std::string_view name(AttributeActionCode value) noexcept {
  return listed(SisoTable::attribute_action, value);
}
std::string_view name(ForceModelKind value) noexcept { return from(kForceModels, value); }
std::string_view name(CellScheme value) noexcept { return from(kCellSchemes, value); }
std::string_view name(CompressedForm value) noexcept { return from(kCompressedForms, value); }
std::string_view name(MembershipAction value) noexcept { return from(kMembershipActions, value); }
std::string_view name(AssuredKind value) noexcept { return from(kAssuredKinds, value); }

}  // namespace reckon::pdu
