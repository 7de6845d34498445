// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/foreign_text.hpp"

#include <algorithm>
#include <array>

namespace reckon::tools {
namespace {

using Octet = unsigned char;

bool is_continuation(Octet octet) { return (octet & 0xC0U) == 0x80U; }

/// Sequences of three octets: line and paragraph separators, directional marks and overrides.
constexpr std::array<std::string_view, 13> kUnseen{"\u200e", "\u200f", "\u2028", "\u2029", "\u202a",
                                                   "\u202b", "\u202c", "\u202d", "\u202e", "\u2066",
                                                   "\u2067", "\u2068", "\u2069"};
constexpr std::string_view kArabicMark = "\u061c";

}  // namespace

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
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

bool is_control(std::string_view letter) {
  const auto first = static_cast<Octet>(letter.front());
  if (letter.size() == 1) return first < 0x20 || first == 0x7F;
  if (letter.size() == 2)
    return (first == 0xC2 && static_cast<Octet>(letter[1]) < 0xA0) || letter == kArabicMark;
  return std::find(kUnseen.begin(), kUnseen.end(), letter) != kUnseen.end();
}

void append_clean_text(std::string& out, std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view letter = text.substr(0, std::max<std::size_t>(length, 1));
    if (length == 0) {
      out += "\ufffd";
    } else if (is_control(letter)) {
      out += '.';
    } else {
      out += letter;
    }
    text.remove_prefix(letter.size());
  }
}

std::string clean_lines(std::string_view text) {
  std::string out;
  for (std::size_t end = 0; !text.empty(); text.remove_prefix(end)) {
    end = std::min(text.find('\n'), text.size());
    append_clean_text(out, text.substr(0, end));
    if (end == text.size()) continue;
    out += '\n';
    ++end;
  }
  return out;
}

}  // namespace reckon::tools
