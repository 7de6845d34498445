// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// PDUs as text for users and programs: a tree of fields, or JSON with the field names of the
// standard in snake case. Both are visitors of the field tables. field_names.hpp has the names of
// values.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/decode_error.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/sized_records.hpp"
#include "reckon/pdu/codec/text_sink.hpp"
#include "reckon/pdu/field_names.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"

namespace reckon::pdu {

/// JSON string with quotes; octets that are not printable ASCII become \u00XX.
void put_json_string(TextSink& sink, std::string_view text);
/// Two hexadecimal digits an octet, no spaces.
void put_hex(TextSink& sink, std::span<const std::byte> octets);

/// Whole numbers up to this magnitude are exact for every reader of JSON, whose numbers are
/// doubles.
inline constexpr std::uint64_t kMostExact = std::uint64_t{1} << 53;

/// One scalar as JSON: NaN and infinity, which JSON lacks, become null. A whole number beyond
/// kMostExact is text: "10428333160412253831".
template <Scalar T>
void put_json_number(TextSink& sink, T value) {
  if constexpr (std::is_integral_v<T> && sizeof(T) == sizeof(std::uint64_t)) {
    const bool exact = std::cmp_less_equal(value, kMostExact) &&
                       std::cmp_greater_equal(value, -static_cast<std::int64_t>(kMostExact));
    if (!exact) sink.text('"');
    sink.number(value);
    if (!exact) sink.text('"');
  } else if constexpr (std::is_enum_v<T>) {
    sink.number(static_cast<unsigned>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    std::isfinite(value) ? sink.number(value) : sink.text("null");
  } else {
    sink.number(value);
  }
}

/// Text of characters up to the first NUL, or hexadecimal octets.
template <typename T, std::size_t n>
void put_json_array(TextSink& sink, const std::array<T, n>& value) {
  if constexpr (std::same_as<T, char>) {
    const std::string_view all(value.data(), n);
    put_json_string(sink, all.substr(0, all.find('\0')));
  } else {
    sink.text('"');
    put_hex(sink, std::as_bytes(std::span(value)));
    sink.text('"');
  }
}

/// "Platform Land United States Tank": kind, domain, country and category as words, or as numbers
/// if they have no name. A country or category of 0 (other) is left out.
void put_type_in_words(TextSink& sink, const EntityType& type);

/// Whether records of this type have readings (field_readings.hpp).
template <typename T>
inline constexpr bool kIsRead = requires(const T& value, FieldReadings& out) {
  read_value(value, out);
};

/// The readings of a record from its own value.
template <typename T>
[[nodiscard]] FieldReadings reading_of(const T& value) noexcept {
  FieldReadings readings;
  if constexpr (kIsRead<T>) read_value(value, readings);
  return readings;
}

/// Visitor: the members of one JSON object, without its braces. With the meanings of the fields,
/// each named value is followed by its name.
class JsonFields {
 public:
  explicit JsonFields(TextSink& sink) noexcept : sink_(sink) {}
  JsonFields(TextSink& sink, FieldMeanings meanings) noexcept
      : sink_(sink), meanings_(meanings), named_(true) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    key(name);
    if constexpr (Scalar<T>) {
      put_json_number(sink_, value);
      if constexpr (kMayHaveNames<T>) {
        if (named_) names(name, value);
      }
      if (named_ && meanings_.has_readings()) readings(name, {});
    } else if constexpr (kIsStdArray<T>) {
      put_json_array(sink_, value);
    } else {
      object(value);
      if (named_ && (kIsRead<T> || meanings_.has_readings())) readings(name, reading_of(value));
    }
  }
  template <typename Record, typename Count>
  void count(std::string_view name, std::span<const std::byte> view, Records<Record, Count>) {
    key(name);
    sink_.number(view.size() / kFixedSize<Record>);
  }
  template <typename Record, typename Count>
  void records(std::string_view name, std::span<const std::byte> view, Records<Record, Count>) {
    key(name);
    sink_.text('[');
    for (bool first = true; !view.empty(); view = view.subspan(kFixedSize<Record>), first = false) {
      if (!first) sink_.text(',');
      record(view, Record{});
    }
    sink_.text(']');
  }
  void walked(std::string_view name, const VariableDatums& datums);
  void walked(std::string_view name, const AttributeRecordSets& sets);
  void walked(std::string_view name, const OctetView auto& view) { hex(name, view.value()); }
  void walked(std::string_view name, const SizedView auto& view) {
    key(name);
    list(view.records(), [this](const auto& item) { sized(item); });
  }

  void object(const auto& value) {
    sink_.text('{');
    JsonFields inner = within(value);
    fields(inner, value);
    sink_.text('}');
  }
  void hex(std::string_view name, std::span<const std::byte> octets);

 private:
  /// Prints the members of a part of this object that is not a record.
  [[nodiscard]] JsonFields part() const {
    return named_ ? JsonFields(sink_, FieldMeanings()) : JsonFields(sink_);
  }
  /// Prints the members of a record of this object.
  [[nodiscard]] JsonFields within(const auto& record) const {
    return named_ ? JsonFields(sink_, FieldMeanings(record)) : JsonFields(sink_);
  }
  void names(std::string_view field, Scalar auto value) {
    const FieldMeaning meaning = meanings_.of(field);
    if (meaning.bits != SisoBits::none)
      bits(field, meaning.bits, static_cast<std::uint32_t>(value));
    else if (const std::string_view text = name_in(meaning, value); !text.empty())
      member(field, "_name", text);
  }
  void bits(std::string_view field, SisoBits set, std::uint32_t word);
  void member(std::string_view field, std::string_view ending, std::string_view text);
  /// Prints the readings of the field, from its record or else from its value alone.
  void readings(std::string_view field, const FieldReadings& of_value);
  void list(const auto& range, auto&& print) {
    sink_.text('[');
    bool first = true;
    for (const auto& item : range) {
      if (!first) sink_.text(',');
      first = false;
      print(item);
    }
    sink_.text(']');
  }
  void attribute_record(const AttributeRecord& item);
  template <typename Head>
  void sized(const SizedRecord<Head>& item) {
    sink_.text('{');
    JsonFields members = within(item.head);
    fields(members, item.head);
    if constexpr (HasParts<Head, JsonFields>) {
      parts(members, item.head, item.body);
    } else {
      members.hex("body", item.body);
    }
    sink_.text('}');
  }
  void key(std::string_view name) {
    if (!first_) sink_.text(',');
    first_ = false;
    sink_.text('"');
    sink_.text(name);
    sink_.text("\":");
  }
  void record(std::span<const std::byte> octets, auto typed) {
    if (load_record(octets, typed)) object(typed);
  }
  void record(std::span<const std::byte> octets, const VariableParameter&) {
    visit_variable_parameter(octets, [this](const auto& typed) { object(typed); });
  }

  TextSink& sink_;
  FieldMeanings meanings_;
  bool named_ = false;
  bool first_ = true;
};

/// Finds whether a record has only numbers and arrays, so that it prints on one line.
class FlatCheck {
 public:
  template <typename T>
  constexpr void operator()(std::string_view, const T&) {
    flat_ = flat_ && (Scalar<T> || kIsStdArray<T>);
  }
  template <typename View, typename R>
  constexpr void count(std::string_view, const View&, R) {}
  template <typename View, typename R>
  constexpr void records(std::string_view, const View&, R) {
    flat_ = false;
  }
  constexpr void walked(std::string_view, const auto&) { flat_ = false; }
  [[nodiscard]] constexpr bool flat() const { return flat_; }

 private:
  bool flat_ = true;
};

template <typename T>
consteval bool is_flat() {
  FlatCheck check;
  const T value{};
  fields(check, value);
  return check.flat();
}

/// Visitor: prints one line a field, indented by two spaces for each level; a flat record stays on
/// one line.
class TreeFields {
 public:
  TreeFields(TextSink& sink, std::size_t depth, bool inline_fields,
             FieldMeanings meanings = {}) noexcept
      : sink_(sink), depth_(depth), inline_(inline_fields), meanings_(meanings) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    start(name);
    if constexpr (Scalar<T>) {
      scalar(name, value);
      if (meanings_.has_readings()) readings(name, {});
    } else if constexpr (kIsStdArray<T>) {
      sink_.text(' ');
      put_json_array(sink_, value);
    } else {
      TreeFields inner(sink_, depth_ + 1, is_flat<T>(), FieldMeanings(value));
      if (!is_flat<T>()) sink_.text('\n');
      fields(inner, value);
      if (!is_flat<T>()) return;
      if (kIsRead<T> || meanings_.has_readings()) readings(name, reading_of(value));
    }
    if (!inline_) sink_.text('\n');
  }
  template <typename Record, typename Count>
  void count(std::string_view name, std::span<const std::byte> view, Records<Record, Count>) {
    (*this)(name, view.size() / kFixedSize<Record>);
  }
  template <typename Record, typename Count>
  void records(std::string_view name, std::span<const std::byte> view, Records<Record, Count>) {
    for (; !view.empty(); view = view.subspan(kFixedSize<Record>)) record(name, view, Record{});
  }
  void walked(std::string_view name, const VariableDatums& datums);
  void walked(std::string_view name, const AttributeRecordSets& sets);
  void walked(std::string_view name, const OctetView auto& view) { hex(name, view.value()); }
  void walked(std::string_view name, const SizedView auto& view) {
    for (const auto& item : view.records()) sized(name, item);
  }
  void hex(std::string_view name, std::span<const std::byte> octets);

 private:
  void attribute_record(const AttributeRecord& item);
  template <typename Head>
  void sized(std::string_view name, const SizedRecord<Head>& item) {
    start(name);
    sink_.text('\n');
    TreeFields inner(sink_, depth_ + 1, false, FieldMeanings(item.head));
    fields(inner, item.head);
    if constexpr (HasParts<Head, TreeFields>) {
      parts(inner, item.head, item.body);
    } else {
      inner.hex("body", item.body);
    }
  }
  void start(std::string_view name);
  template <Scalar T>
  void scalar(std::string_view field, T value) {
    sink_.text(' ');
    if constexpr (std::is_enum_v<T>) {
      sink_.number(static_cast<unsigned>(value));
    } else {
      sink_.number(value);
    }
    if constexpr (kMayHaveNames<T>) {
      const FieldMeaning meaning = meanings_.of(field);
      if (meaning.bits != SisoBits::none)
        bits(meaning.bits, static_cast<std::uint32_t>(value));
      else
        in_parentheses(name_in(meaning, value));
    }
  }
  void in_parentheses(std::string_view text);
  /// What people read in the field, from its record or else from the value alone.
  void readings(std::string_view field, const FieldReadings& of_value);
  /// Each bit field on its own line, or all in parentheses on this line.
  void bits(SisoBits set, std::uint32_t word);
  void record(std::string_view name, std::span<const std::byte> octets, auto typed) {
    if (load_record(octets, typed)) (*this)(name, typed);
  }
  void record(std::string_view name, std::span<const std::byte> octets, const VariableParameter&) {
    visit_variable_parameter(octets, [&](const auto& typed) { (*this)(name, typed); });
  }

  TextSink& sink_;
  std::size_t depth_;
  bool inline_;
  FieldMeanings meanings_;
};

/// `{"header":{...},"entity_id":{...},...}`: every field under its name in the standard, all
/// enumerations as numbers.
void print_json(const auto& value, TextSink& sink) { JsonFields(sink).object(value); }

/// The same with names. Each value with a name is followed by the name,
/// `"country":225,"country_name":"United States"`. The bit fields of a word follow the word,
/// `"entity_appearance":8,"entity_appearance_bits": {"damage":"Slight Damage"}`. The readings of a
/// field follow the field, with units: `"entity_location_read":{"latitude_deg":47.1,...}`.
void print_named_json(const auto& value, TextSink& sink) {
  JsonFields(sink, FieldMeanings(value)).object(value);
}

/// One line a field; each line ends in a newline.
void print_tree(const auto& value, TextSink& sink) {
  TreeFields tree(sink, 0, false, FieldMeanings(value));
  fields(tree, value);
}

/// Decodes and prints one PDU of any type; returns the result of decoding. A damaged PDU: its
/// fields up to the fault, or to its records, and the "rest" in hexadecimal. One without a field
/// table (unknown_type), or of another version: its header and "body" in hexadecimal.
DecodeError print_pdu_json(std::span<const std::byte> pdu, TextSink& sink);
DecodeError print_pdu_tree(std::span<const std::byte> pdu, TextSink& sink);

}  // namespace reckon::pdu
