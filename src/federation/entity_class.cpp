// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/entity_class.hpp"

#include <array>

namespace reckon::peer {
namespace {

std::array<std::uint32_t, 7> numbers(const pdu::EntityType& type) {
  return {static_cast<std::uint32_t>(type.kind),
          static_cast<std::uint32_t>(type.domain),
          type.country,
          type.category,
          type.subcategory,
          type.specific,
          type.extra};
}

}  // namespace

bool EntityClass::contains(const pdu::EntityType& other) const noexcept {
  const auto wanted = numbers(type);
  const auto found = numbers(other);
  std::size_t used = wanted.size();
  while (used > 0 && wanted[used - 1] == 0) --used;
  for (std::size_t i = 0; i < used; ++i) {
    if (wanted[i] != found[i]) return false;
  }
  return true;
}

}  // namespace reckon::peer
