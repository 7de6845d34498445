// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Fields in which two PDUs differ: name, octet and both values, by the field tables of the codec.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace reckon::tools {

/// One field with two values.
struct FieldDifference {
  std::string field;       ///< path, as "entity_location.x" or "variable_parameters[2].value"
  std::size_t offset = 0;  ///< of its first octet in the PDU
  std::string a;           ///< value as text; "absent" if the PDU ends before it
  std::string b;
};

/// The fields in which two PDUs differ, in wire order, at most `most`; empty if all octets are
/// equal. Uses the layout of `a`. For two different types only the header is compared. Octets
/// without a field table are compared as "body". Accepts any octets.
[[nodiscard]] std::vector<FieldDifference> pdu_differences(std::span<const std::byte> a,
                                                           std::span<const std::byte> b,
                                                           std::size_t most = 32);

}  // namespace reckon::tools
