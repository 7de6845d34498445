// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity types as text: by number, or in the words of SISO-REF-010.
#pragma once

#include <string>
#include <string_view>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// An entity type, or the reason why the text is invalid.
struct EntityTypeText {
  pdu::EntityType type;
  std::string error;  ///< empty if valid; else the error and the most similar name, if any
  [[nodiscard]] bool good() const noexcept { return error.empty(); }
};

/// Reads "1.1.225.1.1.0.0": kind.domain.country.category.subcategory.specific.extra; missing
/// numbers are 0. Also reads the output of the inspector, "Platform Land United States Tank": kind,
/// domain and optionally country and category by name, ignoring case. Names end at the category:
/// the parts below it have only numbers.
[[nodiscard]] EntityTypeText parse_entity_type(std::string_view text);

/// The same for a type given in a program.
///
///   truck.type = peer::entity_type("1.1.225.7");
///   federate.publish(peer::EntityClass{peer::entity_type("Platform Land")});
/// @throws std::invalid_argument with the text and the error
[[nodiscard]] pdu::EntityType entity_type(std::string_view text);

/// "1.1.225.1.1.0.0".
[[nodiscard]] std::string entity_type_numbers(const pdu::EntityType& type);
/// "Platform Land United States Tank", as in the inspector.
[[nodiscard]] std::string entity_type_words(const pdu::EntityType& type);

}  // namespace reckon::peer
