// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common fields of the three object state PDUs (types 43 to 45).
#pragma once

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// The first fields of all three.
constexpr void object_head_fields(auto& visitor, auto& pdu) {
  visitor("header", pdu.header);
  visitor("object_id", pdu.object_id);
  visitor("referenced_object_id", pdu.referenced_object_id);
  visitor("update_number", pdu.update_number);
  visitor("force_id", pdu.force_id);
}

/// The requester and the receiver of the request for the object.
constexpr void object_address_fields(auto& visitor, auto& pdu) {
  visitor("requester_simulation_address", pdu.requester_simulation_address);
  visitor("receiving_simulation_address", pdu.receiving_simulation_address);
}

}  // namespace reckon::pdu
