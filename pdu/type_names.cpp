// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/type_names.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "reckon/pdu/codec/siso_names.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::pdu {
namespace {

constexpr std::size_t kTypes = 256;

// Text built in place, so that naming never allocates. Longer text is truncated.
struct ShortText {
  std::array<char, 48> text{};
  std::size_t size = 0;

  constexpr void add(char c) {
    if (size < text.size()) text[size++] = c;
  }
  [[nodiscard]] constexpr std::string_view view() const { return {text.data(), size}; }
};
using Texts = std::array<ShortText, kTypes>;

constexpr ShortText numbered(std::string_view prefix, std::size_t number) {
  ShortText out;
  for (const char c : prefix) out.add(c);
  if (number >= 100) out.add(static_cast<char>('0' + number / 100));
  if (number >= 10) out.add(static_cast<char>('0' + number / 10 % 10));
  out.add(static_cast<char>('0' + number % 10));
  return out;
}

constexpr Texts numbered_table(std::string_view prefix) {
  Texts table;
  for (std::size_t i = 0; i < kTypes; ++i) table[i] = numbered(prefix, i);
  return table;
}

constexpr Texts kUnknownNames = numbered_table("unknown type ");

template <typename T>
constexpr std::string_view own_name() {
  if constexpr (requires { T::kName; }) {
    return T::kName;
  } else {
    static_assert(!is_experimental(T::kPduType), "an experimental PDU says its name: kName");
    return {};
  }
}

template <typename... T>
constexpr auto own_table(TypeList<T...>) {
  std::array<std::string_view, kTypes> names;
  ((names[static_cast<std::size_t>(T::kPduType)] = own_name<T>()), ...);
  return names;
}

constexpr std::array<std::string_view, kTypes> kOwnNames = own_table(PduTypes{});

std::string_view known_name(PduType type) noexcept {
  const std::string_view own = kOwnNames[static_cast<std::size_t>(type)];
  if (!own.empty()) return own;
  return siso_name(SisoTable::pdu_type, static_cast<std::uint32_t>(type));
}

constexpr bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
constexpr bool is_plain(char c) { return is_upper(c) || is_lower(c) || (c >= '0' && c <= '9'); }

// "Start/Resume-R" becomes start_resume_r, "IsPartOf" is_part_of.
ShortText in_snake_case(std::string_view name) {
  ShortText out;
  char last = ' ';
  for (const char c : name) {
    const bool begins = !is_plain(last) || (is_lower(last) && is_upper(c));
    if (is_plain(c) && begins && out.size > 0) out.add('_');
    if (is_plain(c)) out.add(is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c);
    last = c;
  }
  return out;
}

Texts snake_table() {
  Texts table = numbered_table("unknown_");
  for (std::size_t i = 0; i < kTypes; ++i) {
    const std::string_view known = known_name(static_cast<PduType>(i));
    if (!known.empty()) table[i] = in_snake_case(known);
  }
  return table;
}

}  // namespace

std::string_view name(PduType type) noexcept {
  const std::string_view known = known_name(type);
  return known.empty() ? kUnknownNames[static_cast<std::size_t>(type)].view() : known;
}

std::string_view snake_name(PduType type) noexcept {
  static const Texts names = snake_table();
  return names[static_cast<std::size_t>(type)].view();
}

bool is_named(PduType type) noexcept { return !known_name(type).empty(); }

}  // namespace reckon::pdu
