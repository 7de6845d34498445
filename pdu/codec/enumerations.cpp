// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/codec/enumerations.hpp"

#include <array>
#include <cstddef>
#include <string_view>

#include "reckon/pdu/codec/siso_names.hpp"

namespace reckon::pdu {
namespace {

constexpr std::size_t kTypes = 256;

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

/// An enumeration of SISO-REF-010 whose names stand in one table.
template <typename Enumeration>
std::string_view listed(SisoTable table, Enumeration value) {
  return siso_name(table, static_cast<std::uint32_t>(value));
}

constexpr auto kForceModels =
    list("None", "Plane", "Sphere", "Field", "Spring-damper region", "Modal");
constexpr auto kCellSchemes = list("None", "Square", "Hexagonal");
constexpr auto kMembershipActions = list("None", "Join", "Leave", "Lead", "Resign");

}  // namespace

std::string_view name(PduType type) noexcept {
  const std::string_view known = listed(SisoTable::pdu_type, type);
  return known.empty() ? text(kUnknownNames[static_cast<std::size_t>(type)]) : known;
}

std::string_view snake_name(PduType type) noexcept {
  const std::string_view known = listed(SisoTable::pdu_type_key, type);
  return known.empty() ? text(kUnknownSnakeNames[static_cast<std::size_t>(type)]) : known;
}

bool is_named(PduType type) noexcept { return !listed(SisoTable::pdu_type, type).empty(); }

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
std::string_view name(MembershipAction value) noexcept { return from(kMembershipActions, value); }

}  // namespace reckon::pdu
