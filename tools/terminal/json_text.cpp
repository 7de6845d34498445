// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/json_text.hpp"

#include <fmt/format.h>

#include "reckon/tools/terminal/foreign_text.hpp"

namespace reckon::tools {
namespace {

using Octet = unsigned char;

}  // namespace

void append_json_string(std::string& out, std::string_view text) {
  out.push_back('"');
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char letter = text.front();
    if (length == 0) {
      out += "\\ufffd";
    } else if (letter == '"' || letter == '\\') {
      out.push_back('\\');
      out.push_back(letter);
    } else if (static_cast<Octet>(letter) < 0x20 || letter == '\x7f') {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(letter));
    } else if (length == 2 && letter == '\xc2' && static_cast<Octet>(text[1]) < 0xa0) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<Octet>(text[1])));
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  out.push_back('"');
}

}  // namespace reckon::tools
