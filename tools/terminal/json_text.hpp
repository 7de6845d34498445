// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Text of any origin as a JSON string. Numbers and whole PDUs as JSON: pdu/print.hpp.
#pragma once

#include <string>
#include <string_view>

namespace reckon::tools {

/// Appends `text` in quotes; control characters, quotes and backslashes escaped. Any octets will
/// do: what is not UTF-8 becomes U+FFFD, so that the line stays valid JSON.
void append_json_string(std::string& out, std::string_view text);

}  // namespace reckon::tools
