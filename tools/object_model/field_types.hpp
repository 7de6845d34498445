// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The types of all fields of PDUs and records as the data types of an object model (IEEE 1516.2),
// gathered by a visitor of the field tables.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"

namespace reckon::tools {

/// A field: its name as in JSON, and the name of its data type.
struct ModelField {
  std::string name;
  std::string type;
};

/// A number: its octets on the wire, its kind and its unit.
struct ModelNumber {
  std::size_t octets = 0;
  char kind = 'u';   ///< f: IEEE 754, i: signed, u: unsigned
  std::string unit;  ///< "NA": none
};

/// A number with named values.
struct ModelEnumeration {
  std::size_t octets = 0;
  std::vector<std::pair<unsigned, std::string>> values;
};

/// A sequence of elements of one type; `cardinality` is their number.
struct ModelArray {
  std::string element;
  std::string cardinality;
};

/// All data types by name, each once.
struct ModelTypes {
  std::map<std::string, ModelNumber> numbers;
  std::map<std::string, ModelEnumeration> enumerations;
  std::map<std::string, ModelArray> arrays;
  std::map<std::string, std::vector<ModelField>> records;
};

/// SI unit of a number, or of a vector of numbers, by its field name and its record; "NA" if it has
/// none.
[[nodiscard]] std::string_view unit_of(std::string_view record, std::string_view field);

/// "WorldCoordinates" of reckon::pdu::WorldCoordinates.
template <typename T>
[[nodiscard]] constexpr std::string_view struct_name() {
  std::string_view text = __PRETTY_FUNCTION__;
  text = text.substr(text.find("T = ") + 4);
  text = text.substr(0, text.find_first_of(";]"));
  const std::size_t begin = text.rfind("::");
  return begin == std::string_view::npos ? text : text.substr(begin + 2);
}

/// Visitor: the fields of one record and their types.
class FieldTypes {
 public:
  /// @param unit of all numbers; empty: each from unit_of()
  FieldTypes(ModelTypes& types, std::string_view record, std::string_view unit = {})
      : types_(types), record_(record), unit_(unit) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    if constexpr (pdu::Scalar<T>) {
      add(name, number<T>(name));
    } else if constexpr (pdu::kIsStdArray<T>) {
      const bool text = std::is_same_v<typename T::value_type, char>;
      add(name, array(text ? "HLAASCIIchar" : "HLAoctet", std::to_string(value.size())));
    } else {
      add(name, record(value, name));
    }
  }
  void when(bool, std::string_view name, const auto& value) { (*this)(name, value); }
  template <typename View, typename Record, typename Count>
  void count(std::string_view, const View&, pdu::Records<Record, Count>) {}
  template <typename View, typename Record, typename Count>
  void records(std::string_view name, const View&, pdu::Records<Record, Count>) {
    add(name, array(record(Record{}, name), "Dynamic"));
  }
  void walked(std::string_view name, const auto&) { add(name, array("HLAoctet", "Dynamic")); }

  /// Adds a record type with all its fields. @return the name of the type
  template <typename Record>
  [[nodiscard]] std::string record(const Record& value, std::string_view field) {
    const std::string name = plain(struct_name<Record>());
    const bool by_use = is_vector(name);
    const std::string_view unit = by_use ? unit_here(field) : std::string_view{};
    const std::string full = name + (by_use ? suffix(unit) : "");
    if (types_.records.contains(full)) return full;
    types_.records[full];  // prevents a second entry
    FieldTypes inner(types_, name, unit);
    fields(inner, value);
    types_.records[full] = inner.members();
    return full;
  }

  [[nodiscard]] const std::vector<ModelField>& members() const { return members_; }
  /// "_m_per_s" for "m/s"; empty for "NA".
  [[nodiscard]] static std::string suffix(std::string_view unit);

 private:
  /// "Segment_float" for "Segment<float>".
  [[nodiscard]] static std::string plain(std::string_view name);
  /// Whether the unit of a record's numbers depends on its use.
  [[nodiscard]] static bool is_vector(std::string_view record) { return record == "Vector3Float"; }
  [[nodiscard]] std::string_view unit_here(std::string_view field) const {
    return unit_.empty() ? unit_of(record_, field) : unit_;
  }
  void add(std::string_view name, std::string type) {
    members_.push_back({std::string(name), std::move(type)});
  }
  [[nodiscard]] std::string array(const std::string& element, const std::string& cardinality);

  template <typename T>
  [[nodiscard]] std::string number(std::string_view field) {
    if constexpr (std::is_enum_v<T>) {
      const std::string name(struct_name<T>());
      types_.enumerations[name] = {sizeof(T), names_of<T>()};
      return name;
    } else {
      const char kind = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
      return number(sizeof(T), kind, unit_here(field));
    }
  }
  [[nodiscard]] std::string number(std::size_t octets, char kind, std::string_view unit);

  template <typename T>
  [[nodiscard]] static std::vector<std::pair<unsigned, std::string>> names_of() {
    std::vector<std::pair<unsigned, std::string>> values;
    for (unsigned value = 0; value < (1U << (8 * sizeof(T) < 16 ? 8 * sizeof(T) : 16)); ++value) {
      const std::string text = identifier(static_cast<T>(value));
      if (!text.empty()) values.emplace_back(value, text);
    }
    return values;
  }
  template <typename T>
  [[nodiscard]] static std::string identifier(T value) {
    if constexpr (std::is_same_v<T, pdu::PduType>) {
      return pdu::is_named(value) ? identifier(pdu::name(value)) : std::string();
    } else if constexpr (requires { pdu::name(value); }) {
      return identifier(pdu::name(value));
    } else {
      return {};
    }
  }
  [[nodiscard]] static std::string identifier(std::string_view text);

  ModelTypes& types_;
  std::string record_;
  std::string_view unit_;
  std::vector<ModelField> members_;
};

}  // namespace reckon::tools
