// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Supplies of the logistics PDUs.
#pragma once

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Type and quantity of a supply; the unit depends on the type.
struct SupplyQuantity {
  EntityType supply_type;
  float quantity = 0.0F;
};
static_assert(kFixedSize<SupplyQuantity> == 12);

}  // namespace reckon::pdu
