// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity types as a person writes them: by number, or in the words of SISO-REF-010.
#pragma once

#include <string>
#include <string_view>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// An entity type, or why the text is none.
struct EntityTypeText {
  pdu::EntityType type;
  std::string error;  ///< empty when good; else what is wrong and, where one is near, what is meant
  [[nodiscard]] bool good() const noexcept { return error.empty(); }
};

/// Reads "1.1.225.1.1.0.0", kind.domain.country.category.subcategory.specific.extra of which
/// missing ones are 0, or what the inspector writes, "Platform Land United States Tank": kind,
/// domain and perhaps country and category by their names, in any case of letters. Names end at the
/// category: below it types have numbers alone.
[[nodiscard]] EntityTypeText parse_entity_type(std::string_view text);

/// "1.1.225.1.1.0.0".
[[nodiscard]] std::string entity_type_numbers(const pdu::EntityType& type);
/// "Platform Land United States Tank", as the inspector writes it.
[[nodiscard]] std::string entity_type_words(const pdu::EntityType& type);

}  // namespace reckon::peer
