// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Type of an aggregate of entities.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Like an EntityType, but with its own kinds, subcategories and specifics (UID 206 to 209).
struct AggregateType {
  std::uint8_t kind = 0;
  EntityDomain domain = EntityDomain::other;
  std::uint16_t country = 0;
  std::uint8_t category = 0;
  std::uint8_t subcategory = 0;
  std::uint8_t specific = 0;
  std::uint8_t extra = 0;
};
static_assert(kFixedSize<AggregateType> == 8);

}  // namespace reckon::pdu
