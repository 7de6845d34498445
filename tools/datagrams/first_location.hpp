// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Location of a PDU: the first position among its fields.
#pragma once

#include <optional>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// The first position in W among the fields of a decoded PDU, in wire order; nothing if it has
/// none.
[[nodiscard]] std::optional<pdu::WorldCoordinates> first_location(const PduRow& row);

}  // namespace reckon::tools
