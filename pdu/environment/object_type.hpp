// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Type of a terrain object in the synthetic environment PDUs.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Type of a point, linear or areal object.
struct ObjectType {
  std::uint8_t domain = 0;
  std::uint8_t kind = 0;
  std::uint8_t category = 0;
  std::uint8_t subcategory = 0;
};
static_assert(kFixedSize<ObjectType> == 4);

}  // namespace reckon::pdu
