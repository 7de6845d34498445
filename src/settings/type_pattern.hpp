// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Patterns of entity types. Private to the settings.
#pragma once

#include <algorithm>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// Whether `type` matches `pattern`, in which 0 matches any number.
[[nodiscard]] inline bool is_of(const pdu::EntityType& type,
                                const pdu::EntityType& pattern) noexcept {
  return std::ranges::equal(type.numbers(), pattern.numbers(), [](auto number, auto wanted) {
    return wanted == 0 || number == wanted;
  });
}

}  // namespace reckon::peer
