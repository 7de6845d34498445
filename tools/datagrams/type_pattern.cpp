// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/type_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "reckon/peer/notation/entity_type_text.hpp"

namespace reckon::tools {
namespace {

constexpr std::array<std::string_view, 7> kParts{"kind",        "domain",   "country", "category",
                                                 "subcategory", "specific", "extra"};
constexpr std::size_t kCountry = 2;

constexpr unsigned most_of(std::size_t part) { return part == kCountry ? 65535 : 255; }

bool is_dotted(std::string_view text) {
  return text.find_first_not_of("0123456789.*") == std::string_view::npos;
}

TypePatternText by_words(std::string_view text) {
  const peer::EntityTypeText parsed = peer::parse_entity_type(text);
  TypePatternText out{{}, parsed.error};
  std::ranges::copy(parsed.type.numbers(), out.pattern.parts.begin());
  return out;
}

TypePatternText by_numbers(std::string_view text) {
  TypePatternText out;
  for (std::size_t part = 0;; ++part) {
    const std::size_t end = std::min(text.find('.', out.at), text.size());
    const std::string_view number = text.substr(out.at, end - out.at);
    if (part == kParts.size()) {
      out.error = "an entity type has at most 7 parts, from kind to extra";
      return out;
    }
    unsigned value = 0;
    const char* const last = number.data() + number.size();
    const auto read = std::from_chars(number.data(), last, value);
    const bool is_number = read.ec == std::errc() && read.ptr == last && value <= most_of(part);
    if (!is_number && number != "*") {
      out.error = fmt::format("the {} '{}' is neither * nor a number from 0 to {}", kParts[part],
                              number, most_of(part));
      return out;
    }
    if (is_number) out.pattern.parts[part] = static_cast<std::uint16_t>(value);
    if (end == text.size()) return out;
    out.at = end + 1;
  }
}

}  // namespace

bool TypePattern::matches(const pdu::EntityType& type) const noexcept {
  const auto found = type.numbers();
  return std::equal(parts.begin(), parts.end(), found.begin(),
                    [](const auto& wanted, std::uint16_t is) { return wanted.value_or(is) == is; });
}

TypePatternText parse_type_pattern(std::string_view text) {
  TypePatternText out = is_dotted(text) ? by_numbers(text) : by_words(text);
  auto& parts = out.pattern.parts;
  for (auto part = parts.rbegin(); part != parts.rend() && part->value_or(0) == 0; ++part)
    part->reset();
  return out;
}

}  // namespace reckon::tools
