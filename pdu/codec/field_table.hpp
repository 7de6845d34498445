// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The central idea of this folder: every PDU and every record names its fields ONCE, in wire order,
// in a function template `fields(visitor, value)`; a plain record does so by its members, which the
// `fields` of members.hpp lists. Encoding, decoding, size, printing, JSON, random
// test values and the tables in the documentation are visitors of that description.
//
// Interface of a visitor:
//   visitor("name", value)              a number, an enumeration, an array of octets or characters,
//                                       or a record that has its own `fields`
//   visitor.count("name", span, Records<T, Count>{})
//                                       the number of records T in `span`, as a Count
//   visitor.records("name", span, Records<T, Count>{})
//                                       the records themselves: kFixedSize<T> octets each
//   visitor.walked("name", view)        records of varying size; `view` has `count` and `bytes`
//                                       and `static WalkResult walk(count, octets)`
// `when(present, visitor, "name", value)` is a field that is present only if other fields say so.
// Fixed fields precede all variable parts and conditional fields, as in every PDU of the standard.
// After those, a field that is always present is a `when(true, ...)`.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>

#include "reckon/pdu/codec/decode_error.hpp"
#include "reckon/pdu/codec/members.hpp"

namespace reckon::pdu {

/// T or const T: one `fields` serves readers and writers.
template <typename Candidate, typename T>
concept Is = std::same_as<std::remove_const_t<Candidate>, T>;

/// One of several T, or const: for field lists that several records share.
template <typename Candidate, typename... T>
concept IsOneOf = (Is<Candidate, T> || ...);

/// A number or an enumeration, stored big-endian.
template <typename T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Names the record type and the type of the count field of a block of equal records.
template <typename RecordType, typename CountType>
struct Records {
  using Record = RecordType;
  using Count = CountType;
};

/// Octets of `count` records of varying size, or the reason why they do not fit.
struct WalkResult {
  std::size_t size = 0;
  DecodeError error = DecodeError::none;
};

template <typename T>
inline constexpr bool kIsStdArray = false;
template <typename T, std::size_t n>
inline constexpr bool kIsStdArray<std::array<T, n>> = true;

/// A field that is on the wire only if `present` is true. Earlier fields determine `present`.
/// Visitors that measure or read have their own `when`. For the others it is a normal field, or
/// absent.
constexpr void when(bool present, auto& visitor, std::string_view name, auto& value) {
  if constexpr (requires { visitor.when(present, name, value); }) {
    visitor.when(present, name, value);
  } else if (present) {
    visitor(name, value);
  }
}

/// A variable part that is on the wire only if `present` is true.
template <typename Visitor, typename View>
constexpr void walked_when(bool present, Visitor& visitor, std::string_view name, View& view) {
  if (present) {
    visitor.walked(name, view);
  } else if constexpr (!std::is_const_v<View>) {
    view.bytes = {};
  }
}

/// Adds up the fixed part of a record or PDU; usable at compile time.
class FixedSize {
 public:
  template <typename T>
  constexpr void operator()(std::string_view, const T& value) {
    if constexpr (Scalar<T>) {
      add(sizeof(T));
    } else if constexpr (kIsStdArray<T>) {
      static_assert(sizeof(typename T::value_type) == 1, "arrays on the wire are of octets");
      add(value.size());
    } else {
      fields(*this, value);
    }
  }
  template <typename Span, typename Record, typename Count>
  constexpr void count(std::string_view, const Span&, Records<Record, Count>) {
    add(sizeof(Count));
  }
  template <typename Span, typename Record, typename Count>
  constexpr void records(std::string_view, const Span&, Records<Record, Count>) {
    variable_ = true;
  }
  constexpr void walked(std::string_view, const auto&) {
    variable_ = true;
  }

  constexpr void when(bool, std::string_view, const auto&) {
    variable_ = true;
  }

  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  /// Whether no fixed field followed a variable part.
  [[nodiscard]] constexpr bool ordered() const { return ordered_; }

 private:
  constexpr void add(std::size_t octets) {
    size_ += octets;
    ordered_ = ordered_ && !variable_;
  }

  std::size_t size_ = 0;
  bool variable_ = false;
  bool ordered_ = true;
};

template <typename T>
consteval std::size_t fixed_size() {
  FixedSize size;
  const T value{};
  fields(size, value);
  return size.ordered() ? size.size() : throw "a fixed field stands behind a variable part";
}

/// Octets of the fixed part of a PDU, or of a whole record; a compile-time constant.
template <typename T>
inline constexpr std::size_t kFixedSize = fixed_size<T>();

}  // namespace reckon::pdu
