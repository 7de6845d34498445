// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of PDU types: for types of the standard the names in SISO's list, for ours the names in
// their headers.
#pragma once

#include <string_view>

#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::pdu {

/// "Entity State"; "unknown type 200" if there is no name. Static text, never empty.
[[nodiscard]] std::string_view name(PduType type) noexcept;
/// The name in snake case, "entity_state"; "unknown_200" if there is no name.
[[nodiscard]] std::string_view snake_name(PduType type) noexcept;
/// Whether the type has a name: 0 to 72, which IEEE 1278.1-2012 defines, and our own types.
[[nodiscard]] bool is_named(PduType type) noexcept;

}  // namespace reckon::pdu
