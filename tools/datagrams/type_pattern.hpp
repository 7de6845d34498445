// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A class of entity types in filter syntax: "1.1.225.*", "Platform Land".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::tools {

/// Kind, domain, country, category, subcategory, specific and extra; none matches any number.
struct TypePattern {
  std::array<std::optional<std::uint16_t>, 7> parts;

  [[nodiscard]] bool matches(const pdu::EntityType& type) const noexcept;
};

/// A pattern, or the reason why the text is invalid.
struct TypePatternText {
  TypePattern pattern;
  std::string error{};  ///< empty if valid
  std::size_t at = 0;   ///< offset of the wrong part in the text
};

/// Reads numbers with dots between them; each may be *. Omitted parts and zeros at the end match
/// any number, as in peer::EntityClass. Also reads the words of peer::parse_entity_type().
[[nodiscard]] TypePatternText parse_type_pattern(std::string_view text);

}  // namespace reckon::tools
