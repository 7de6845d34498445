// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of the values of a field. The printer uses them for every field, so that a value of any PDU
// gets its name by one row in field_names.cpp. Most fields are identified by their own name.
// `meaning_in` is overloaded for a record whose values have another meaning or depend on its other
// fields.
#pragma once

#include <string_view>

#include "reckon/pdu/codec/siso_names.hpp"
#include "reckon/pdu/pdu_types.hpp"

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

/// The meanings of the fields of one record, which must outlive it; without a record, by the names
/// of the fields alone.
class FieldMeanings {
 public:
  FieldMeanings() = default;
  template <typename Record>
  explicit FieldMeanings(const Record& record) noexcept
      : record_(&record), in_record_([](const void* any, std::string_view field) {
          return meaning_in(*static_cast<const Record*>(any), field);
        }) {}

  [[nodiscard]] FieldMeaning of(std::string_view field) const noexcept {
    return record_ == nullptr ? field_meaning(field) : in_record_(record_, field);
  }

 private:
  const void* record_ = nullptr;
  FieldMeaning (*in_record_)(const void*, std::string_view) = nullptr;
};

}  // namespace reckon::pdu
