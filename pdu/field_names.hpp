// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of the values of a field. The printer uses them for every field, so that a value of any PDU
// gets its name by one row in field_names.cpp. Most fields are identified by their own name.
// `meaning_in` is overloaded for a record whose values have another meaning or depend on its other
// fields.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "reckon/pdu/codec/siso_names.hpp"
#include "reckon/pdu/field_readings.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"

namespace reckon::pdu {

/// Meaning of a field's value: a value with a name, or bits that are separate fields.
struct FieldMeaning {
  SisoTable values = SisoTable::none;
  SisoBits bits = SisoBits::none;
};

/// Meaning of a field from its name alone.
[[nodiscard]] FieldMeaning field_meaning(std::string_view field) noexcept;

/// Meaning of a field in a record: from its name for most records.
template <typename Record>
[[nodiscard]] FieldMeaning meaning_in(const Record&, std::string_view field) noexcept {
  return field_meaning(field);
}
[[nodiscard]] FieldMeaning meaning_in(const PduHeader& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const EntityType& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const AggregateType& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const ObjectType& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const EntityState& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const Appearance& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const RadioEntityType& record,
                                      std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const AttachedPart& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const ModulationType& record,
                                      std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const DirectedEnergyFire& record,
                                      std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const EnvironmentRecord& record,
                                      std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const StandardVariableRecord& record,
                                      std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const Signal& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const IntercomSignal& record,
                                      std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const RecordR& record, std::string_view field) noexcept;
[[nodiscard]] FieldMeaning meaning_in(const RecordQueryR& record, std::string_view field) noexcept;

/// Whether values of this type may have names: enumerations and whole numbers of up to 32 bits.
template <typename T>
inline constexpr bool kMayHaveNames = std::is_enum_v<T> ||
                                      (std::is_integral_v<T> && sizeof(T) <= sizeof(std::uint32_t));

/// The name of a value by the meaning of its field, else by its own type; "" if it has none.
template <Scalar T>
std::string_view name_in(const FieldMeaning& meaning, T value) {
  if (meaning.values != SisoTable::none)
    return siso_name(meaning.values, static_cast<std::uint32_t>(value));
  if constexpr (std::is_enum_v<T>) return pdu::name(value);
  return {};
}

/// The meanings of the fields of one record, which must outlive it; without a record, by the names
/// of the fields alone.
class FieldMeanings {
 public:
  FieldMeanings() = default;
  template <typename Record>
  explicit FieldMeanings(const Record& record) noexcept
      : record_(&record), in_record_([](const void* any, std::string_view field) {
          return meaning_in(*static_cast<const Record*>(any), field);
        }) {
    if constexpr (requires(FieldReadings & out) { read_field(record, "", out); })
      read_in_record_ = [](const void* any, std::string_view field, FieldReadings& out) {
        read_field(*static_cast<const Record*>(any), field, out);
      };
  }

  [[nodiscard]] FieldMeaning of(std::string_view field) const noexcept {
    return record_ == nullptr ? field_meaning(field) : in_record_(record_, field);
  }
  /// Whether fields of the record may have readings that depend on it.
  [[nodiscard]] bool has_readings() const noexcept { return read_in_record_ != nullptr; }
  void read(std::string_view field, FieldReadings& out) const noexcept {
    if (has_readings()) read_in_record_(record_, field, out);
  }

 private:
  const void* record_ = nullptr;
  FieldMeaning (*in_record_)(const void*, std::string_view) = nullptr;
  void (*read_in_record_)(const void*, std::string_view, FieldReadings&) = nullptr;
};

}  // namespace reckon::pdu
