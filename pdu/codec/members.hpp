// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The field table of a plain record: its members with their names, as declared. C++20 has no
// reflection. Structured bindings give the members, and the compiler's text for a pointer to a
// member ends in its name.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace reckon::pdu {
namespace members {

/// Stands for a value of any type where members are counted; never evaluated.
struct AnyValue {
  template <typename T>
  constexpr operator T() const;  // NOLINT: implicit, as the initial value of a member
};

template <typename T, typename... Values>
consteval std::size_t count() {
  if constexpr (requires { T{Values{}..., AnyValue{}}; }) {
    return count<T, Values..., AnyValue>();
  } else {
    return sizeof...(Values);
  }
}

/// Calls `visit` with all members, in the order of declaration.
template <typename T, typename Visit>
[[gnu::always_inline]] constexpr auto with(T& record, const Visit& visit) {
  constexpr std::size_t size = count<std::remove_const_t<T>>();
  if constexpr (size == 1) {
    auto& [a] = record;
    return visit(a);
  } else if constexpr (size == 2) {
    auto& [a, b] = record;
    return visit(a, b);
  } else if constexpr (size == 3) {
    auto& [a, b, c] = record;
    return visit(a, b, c);
  } else if constexpr (size == 4) {
    auto& [a, b, c, d] = record;
    return visit(a, b, c, d);
  } else if constexpr (size == 5) {
    auto& [a, b, c, d, e] = record;
    return visit(a, b, c, d, e);
  } else if constexpr (size == 6) {
    auto& [a, b, c, d, e, f] = record;
    return visit(a, b, c, d, e, f);
  } else if constexpr (size == 7) {
    auto& [a, b, c, d, e, f, g] = record;
    return visit(a, b, c, d, e, f, g);
  } else if constexpr (size == 8) {
    auto& [a, b, c, d, e, f, g, h] = record;
    return visit(a, b, c, d, e, f, g, h);
  } else if constexpr (size == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = record;
    return visit(a, b, c, d, e, f, g, h, i);
  } else if constexpr (size == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = record;
    return visit(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (size == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = record;
    return visit(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (size == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = record;
    return visit(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (size == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = record;
    return visit(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (size == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = record;
    return visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else {
    static_assert(size == 1, "a record of this size needs a `fields` of its own");
  }
}

/// A record whose members have addresses at compile time.
template <typename T>
inline constexpr T kSample{};

template <typename T>
inline constexpr auto kAddresses = with(kSample<T>, [](const auto&... member) {
  return std::tuple{&member...};
});

template <typename Pointer>
struct Address {
  Pointer to;
};
template <typename Pointer>
Address(Pointer) -> Address<Pointer>;

template <Address address>
consteval auto spelled() {
  return __PRETTY_FUNCTION__;
}

constexpr std::string_view last_word(std::string_view text) {
  const auto in_word = [](char c) {
    return c == '_' || ('0' <= c && c <= '9') || ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
  };
  while (!in_word(text.back())) text.remove_suffix(1);
  std::size_t begin = text.size();
  while (in_word(text[begin - 1])) --begin;
  return text.substr(begin);
}

/// Its name alone, so that no longer text gets into the program.
template <Address address>
inline constexpr auto kLetters = [] {
  constexpr std::string_view word = last_word(spelled<address>());
  std::array<char, word.size()> letters{};
  std::ranges::copy(word, letters.begin());
  return letters;
}();

template <typename T>
inline constexpr auto kNames = []<std::size_t... i>(std::index_sequence<i...>) {
  return std::array{std::string_view(kLetters<Address{std::get<i>(kAddresses<T>)}>.data(),
                                     kLetters<Address{std::get<i>(kAddresses<T>)}>.size())...};
}
(std::make_index_sequence<count<T>()>());

template <typename T, typename Visitor>
struct Each {
  template <typename... Member>
  [[gnu::always_inline]] constexpr void operator()(Member&... member) const {
    const std::string_view* next = kNames<T>.data();
    (one(*next++, member), ...);
  }

  template <typename Member>
  [[gnu::always_inline]] constexpr void one(std::string_view name, Member& member) const {
    if constexpr (requires { Member::kInlined; }) {
      fields(visitor, member);
    } else {
      visitor(name, member);
    }
  }

  Visitor& visitor;
};

}  // namespace members

/// The field table of a struct that has none of its own: all members in the order of declaration.
/// They are numbers, enumerations, arrays of octets or records; 14 at most. The fields of a record
/// that declares `kInlined` are direct fields of the struct.
template <typename Visitor, typename Record>
constexpr void fields(Visitor& visitor, Record& record) {
  members::with(record, members::Each<std::remove_const_t<Record>, Visitor>{visitor});
}

}  // namespace reckon::pdu
