// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lists all fields that PDUs may have, from an example of each type, and finds the fields that a
// path names.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "reckon/pdu/field_search.hpp"
#include "reckon/pdu/field_walk.hpp"

namespace reckon::pdu {

/// The records that enclose the visited field, from the PDU inwards.
class FieldPlace {
 public:
  [[nodiscard]] bool is_full() const { return depth_ == parts_.size(); }
  void enter(std::string_view name, std::size_t index) { parts_[depth_++] = {name, index}; }
  void leave() { --depth_; }
  [[nodiscard]] std::span<const FieldPath::Part> parts() const {
    return std::span(parts_).first(depth_);
  }

 private:
  std::array<FieldPath::Part, FieldPath::kDeepest> parts_{};
  std::size_t depth_ = 0;
};

/// The path of the wanted fields, without a bit field.
struct FieldGoal {
  std::span<const FieldPath::Part> parts;
  bool whole = false;  ///< the path begins at the PDU

  [[nodiscard]] bool is_at(const FieldPlace& place, const FieldPath::Part& field) const {
    const std::span<const FieldPath::Part> around = place.parts();
    if (parts.empty()) return true;
    if (!is_same(field, parts.back()) || around.size() + 1 < parts.size() ||
        (whole && around.size() + 1 != parts.size()))
      return false;
    const auto outer = parts.first(parts.size() - 1);
    return std::equal(outer.begin(), outer.end(),
                      around.end() - static_cast<std::ptrdiff_t>(outer.size()),
                      [](const auto& wanted, const auto& there) { return is_same(there, wanted); });
  }
  /// Whether a wanted field may be inside a record at this place.
  [[nodiscard]] bool may_be_in(const FieldPlace& place, const FieldPath::Part& record) const {
    if (!whole) return true;
    const std::size_t depth = place.parts().size();
    return depth + 1 < parts.size() && is_same(record, parts[depth]);
  }

 private:
  [[nodiscard]] static bool is_same(const FieldPath::Part& there, const FieldPath::Part& wanted) {
    return (wanted.index == kNoIndex || there.index == kNoIndex || there.index == wanted.index) &&
           there.name == wanted.name;
  }
};

/// Records that count as one value.
template <typename T>
concept OneId =
    std::same_as<T, EntityId> || std::same_as<T, LiveEntityId> || std::same_as<T, EventId> ||
    std::same_as<T, SimulationAddress> || std::same_as<T, LiveSimulationAddress>;

/// What kind of value a field has.
enum class FieldValueClass : std::uint8_t { number, named_number, other };

/// Handler of a walk through examples: reports each field.
class FieldList {
 public:
  struct Field {
    PduType type = PduType::other;
    std::span<const FieldPath::Part> around{};
    FieldPath::Part part{};
    FieldValueClass value = FieldValueClass::other;
    FieldMeaning meaning{};                           ///< in this example
    std::string_view (*name_of)(unsigned) = nullptr;  ///< of an enumeration
    unsigned values = 0;                              ///< of an enumeration: its values are below
  };
  using Report = void (*)(void* context, const FieldPlace& place, const Field& field);
  static constexpr bool kExamples = true;
  FieldList(void* context, Report callback) : context_(context), report_(callback) {}

  /// The fields reported from now on belong to PDUs of this type.
  void begin(PduType type) { type_ = type; }
  template <typename Record>
  bool enter(std::string_view name, std::size_t index, const Record&) {
    if constexpr (OneId<Record>) report(name, FieldValueClass::other);
    if (place_.is_full()) return false;
    place_.enter(name, index);
    return true;
  }
  void leave() { place_.leave(); }
  template <typename T>
  void leaf(std::string_view name, const T&, const FieldMeanings& meanings) {
    if constexpr (!Scalar<T>) {
      report(name, FieldValueClass::other);
    } else {
      Field field{
          .value = kMayHaveNames<T> ? FieldValueClass::named_number : FieldValueClass::number,
          .meaning = meanings.of(name)};
      if constexpr (std::is_enum_v<T>) {
        field.name_of = [](unsigned value) { return pdu::name(static_cast<T>(value)); };
        field.values = sizeof(T) > 1 ? 0x10000U : 0x100U;
      }
      report(name, field);
    }
  }
  void octets(std::string_view name, std::span<const std::byte>) {
    report(name, FieldValueClass::other);
  }

 private:
  void report(std::string_view name, FieldValueClass value) { report(name, Field{.value = value}); }
  void report(std::string_view name, Field field) {
    field.type = type_;
    field.around = place_.parts();
    field.part = {name, kNoIndex};
    report_(context_, place_, field);
  }

  void* context_;
  Report report_;
  FieldPlace place_;
  PduType type_ = PduType::other;
};

/// Reports the fields of each type, or of one. A type without a field table has only a header.
void list_fields(FieldList& list, std::optional<PduType> only);

}  // namespace reckon::pdu
