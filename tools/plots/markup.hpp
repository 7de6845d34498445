// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Escapes text for HTML, SVG and XML.
#pragma once

#include <string>
#include <string_view>

namespace reckon::tools {

/// Appends `text` of any origin, escaped for an element or an attribute.
inline void append_escaped(std::string& out, std::string_view text) {
  for (const char letter : text) {
    if (letter == '&')
      out += "&amp;";
    else if (letter == '<')
      out += "&lt;";
    else if (letter == '>')
      out += "&gt;";
    else if (letter == '"')
      out += "&quot;";
    else
      out += letter;
  }
}

}  // namespace reckon::tools
