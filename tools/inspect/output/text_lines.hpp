// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The inspector's text output: one line per PDU, or a tree of all its fields.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// The escape sequence that colours a rule of this status; end it with "\x1b[0m".
[[nodiscard]] std::string_view colour_of(PduStatus status);

/// Titles of the columns of append_tail_line(), newline included.
void append_tail_titles(std::string& out);

/// Appends one line: frame, PDU, octet offset, seconds since `start`, type, length, ID, and the
/// PDU's content or its error. For Compressed States a line for each state follows, with its own
/// octets.
void append_tail_line(std::string& out, const PduRow& row, std::chrono::nanoseconds start,
                      bool colour);

/// Appends a heading and one line for each field; for an unreadable PDU its header and octets. For
/// Compressed States the same follows for each state, or the reason why it cannot be restored.
void append_tree(std::string& out, const PduRow& row, bool colour);

}  // namespace reckon::tools
