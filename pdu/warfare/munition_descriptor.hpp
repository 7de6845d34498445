// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The munition or expendable of Fire and Detonation PDUs.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// The same 16 octets for munitions and expendables (padding in place of warhead to rate).
struct MunitionDescriptor {
  EntityType munition_type;
  std::uint16_t warhead = 0;
  std::uint16_t fuse = 0;
  std::uint16_t quantity = 0;
  std::uint16_t rate = 0;  ///< [1/min]
};

template <typename Visitor, Is<MunitionDescriptor> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("munition_type", record.munition_type);
  visitor("warhead", record.warhead);
  visitor("fuse", record.fuse);
  visitor("quantity", record.quantity);
  visitor("rate", record.rate);
}
static_assert(kFixedSize<MunitionDescriptor> == 16);

}  // namespace reckon::pdu
