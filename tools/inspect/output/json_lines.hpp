// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// JSON Lines of the inspector. docs/json_lines.md documents every key; other tools depend on them.
#pragma once

#include <string>

#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// Appends one line, newline included. `full` adds "fields" with every field of the PDU. Allocates
/// only while `out` grows.
void append_json_line(std::string& out, const PduRow& row, bool full);

}  // namespace reckon::tools
