// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Patterns of entity types. Private to the settings.
#pragma once

#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// Whether `type` matches `pattern`, in which 0 matches any number.
[[nodiscard]] inline bool is_of(const pdu::EntityType& type, const pdu::EntityType& pattern) noexcept {
  const auto fits = [](auto value, auto wanted) {
    return wanted == decltype(wanted){} || value == wanted;
  };
  return fits(type.kind, pattern.kind) && fits(type.domain, pattern.domain) &&
         fits(type.country, pattern.country) && fits(type.category, pattern.category) &&
         fits(type.subcategory, pattern.subcategory) && fits(type.specific, pattern.specific) &&
         fits(type.extra, pattern.extra);
}

}  // namespace reckon::peer
