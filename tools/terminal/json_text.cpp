// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/json_text.hpp"

#include <fmt/format.h>

namespace reckon::tools {
namespace {

using Octet = unsigned char;

bool is_continuation(Octet octet) { return (octet & 0xC0U) == 0x80U; }

/// Octets of the UTF-8 sequence that `text` begins with, 0 where it is none (RFC 3629: no overlong
/// form, no surrogate, nothing above U+10FFFF).
std::size_t utf8_length(std::string_view text) {
  const auto at = [&](std::size_t i) {
    return i < text.size() ? static_cast<Octet>(text[i]) : Octet{0};
  };
  const Octet first = at(0);
  const Octet second = at(1);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4 || !is_continuation(second)) return 0;
  if (first < 0xE0) return 2;
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F) ||
      !is_continuation(at(2)))
    return 0;
  if (first < 0xF0) return 3;
  return is_continuation(at(3)) ? 4 : 0;
}

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
