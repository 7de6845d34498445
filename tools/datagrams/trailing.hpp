// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Explains octets after the last field of a PDU, which the codec skips: their content, and the
// count or length field that should include them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "reckon/pdu/codec/pdu_header.hpp"

namespace reckon::tools {

/// The first 16 octets in hexadecimal, and "..." if there are more.
[[nodiscard]] std::string start_in_hex(std::span<const std::byte> octets);

/// "32 octets after the last field: 0001...; number_of_variable_parameter_records is 0, and 2 more
/// records are present". The cause is given only if one fits. `octets` are one decodable PDU, whose
/// last `behind` octets belong to no field.
[[nodiscard]] std::string explain_trailing(std::span<const std::byte> octets,
                                           const pdu::PduHeader& header, std::size_t behind);

}  // namespace reckon::tools
