// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Walks through all fields of a PDU, also those in its records, under the names that JSON has for
// them. The field tables drive it. A handler takes what comes:
//   bool enter(name, index, record)   a record begins; false: its fields are skipped
//   void leave()                      a record that was entered ends
//   void leaf(name, value, meanings)  a number, an enumeration, or an array of octets or characters
//   void octets(name, span)           a part that stays octets
//   static constexpr bool kExamples   false: the PDU as it is. true: no values, but each kind of
//                                     record that may be there once, and each field that may be
//                                     absent
// and, where it has them:
//   void list(name)                   records of a list may follow, each under this name
//   void extent(octets)               before leave(): the whole record in the datagram; its last
//                                     octets may belong to no field
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/sized_records.hpp"
#include "reckon/pdu/field_names.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::pdu {

/// The index of a record that is no element of a list.
inline constexpr std::size_t kNoIndex = static_cast<std::size_t>(-1);

/// Calls `f(head, body)` for each layout that the body of a record with this kind of head may have.
template <typename Head, typename F>
void each_layout(const Head& head, F&& f) {
  static constexpr std::array<std::byte, 64> kZeros{};
  const std::span<const std::byte> zeros(kZeros);
  if constexpr (std::is_same_v<Head, IffLayer>) {
    for (const auto& [layer, size] :
         {std::pair<std::uint8_t, std::size_t>{2, 24}, {3, 24}, {4, 0}, {4, 32}, {5, 12}})
      f(IffLayer{layer}, zeros.first(size));
    // Mode S of a transponder: it identifies an aircraft.
    static constexpr std::array<std::byte, 32> kTransponder = [] {
      std::array<std::byte, 32> octets{};
      octets[8] = std::byte{'A'};
      return octets;
    }();
    f(IffLayer{4}, std::span<const std::byte>(kTransponder));
  } else if constexpr (std::is_same_v<Head, EnvironmentRecord>) {
    for (const std::uint32_t type : {0U, 65536U, 655360U, 786432U, 1048576U, 5242880U})
      f(EnvironmentRecord{type}, zeros);
  } else if constexpr (std::is_same_v<Head, GridSamples>) {
    for (std::uint16_t representation = 0; representation < 3; ++representation)
      f(GridSamples{0, representation}, zeros.first(16));
  } else if constexpr (std::is_same_v<Head, GridAxis>) {
    f(head, zeros.first(16));
  } else {
    f(head, zeros.first(0));
  }
}

/// Visitor of field tables; see the head of this file.
template <typename Handler>
class FieldWalk {
 public:
  template <typename Record>
  FieldWalk(Handler& handler, const Record& record) noexcept
      : handler_(handler), meanings_(record) {}
  explicit FieldWalk(Handler& handler) noexcept : handler_(handler) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    if constexpr (Scalar<T> || kIsStdArray<T>)
      handler_.leaf(name, value, meanings_);
    else
      record(name, kNoIndex, value);
  }
  template <typename T>
  void when(bool present, std::string_view name, const T& value) {
    if (present || Handler::kExamples) (*this)(name, value);
  }
  template <typename Record, typename Count>
  void count(std::string_view name, std::span<const std::byte> view, Records<Record, Count>) {
    handler_.leaf(name, static_cast<Count>(view.size() / kFixedSize<Record>), meanings_);
  }
  template <typename Record, typename Count>
  void records(std::string_view name, std::span<const std::byte> view, Records<Record, Count>) {
    list(name);
    if constexpr (Handler::kExamples) {
      example(name, Record{});
    } else {
      constexpr std::size_t kSize = kFixedSize<Record>;
      for (std::size_t i = 0; (i + 1) * kSize <= view.size(); ++i)
        element(name, i, view.subspan(i * kSize, kSize), Record{});
    }
  }
  template <OctetView View>
  void walked(std::string_view name, const View& view) {
    handler_.octets(name, view.value());
  }
  template <SizedView View>
  void walked(std::string_view name, const View& view) {
    list(name);
    if constexpr (Handler::kExamples) {
      each_layout(typename View::Head{}, [&](const auto& head, std::span<const std::byte> body) {
        sized(name, kNoIndex, head, body);
      });
    } else {
      std::size_t index = 0;
      for (const auto& item : view.records()) sized(name, index++, item.head, item.body);
    }
  }
  void walked(std::string_view name, const VariableDatums& datums) {
    list(name);
    std::size_t index = 0;
    if constexpr (Handler::kExamples) datum(name, kNoIndex, {}, {});
    for (const VariableDatum& item : datums.records()) datum(name, index++, item, datums.bytes);
  }
  void walked(std::string_view name, const AttributeRecordSets& sets) {
    list(name);
    Attribute pdu;
    pdu.record_sets = sets;
    std::size_t index = 0;
    if constexpr (Handler::kExamples) attribute_set(name, kNoIndex, {});
    for (const AttributeSet& set : AttributeReader(pdu)) attribute_set(name, index++, set);
  }

 private:
  void list(std::string_view name) {
    if constexpr (requires { handler_.list(name); }) handler_.list(name);
  }
  /// @param head octets of the record before `behind`
  void extent(std::size_t head, std::span<const std::byte> behind) {
    if constexpr (requires { handler_.extent(behind); })
      handler_.extent({behind.data() - head, head + behind.size()});
  }
  template <typename Record>
  void record(std::string_view name, std::size_t index, const Record& value) {
    if (!handler_.enter(name, index, value)) return;
    FieldWalk inner(handler_, value);
    fields(inner, value);
    handler_.leave();
  }
  template <typename Record>
  void element(std::string_view name, std::size_t index, std::span<const std::byte> octets,
               Record typed) {
    if (load_record(octets, typed)) record(name, index, std::as_const(typed));
  }
  void element(std::string_view name, std::size_t index, std::span<const std::byte> octets,
               const VariableParameter&) {
    visit_variable_parameter(octets, [&](const auto& typed) { record(name, index, typed); });
  }
  template <typename Record>
  void example(std::string_view name, const Record& value) {
    record(name, kNoIndex, value);
  }
  void example(std::string_view name, const VariableParameter& any) {
    record(name, kNoIndex, ArticulatedPart{});
    record(name, kNoIndex, AttachedPart{});
    record(name, kNoIndex, Separation{});
    record(name, kNoIndex, EntityTypeParameter{});
    record(name, kNoIndex, EntityAssociation{});
    record(name, kNoIndex, any);
  }
  template <typename Head>
  void sized(std::string_view name, std::size_t index, const Head& head,
             std::span<const std::byte> body) {
    if (!handler_.enter(name, index, head)) return;
    FieldWalk inner(handler_, head);
    fields(inner, head);
    if constexpr (HasParts<Head, FieldWalk>)
      parts(inner, head, body);
    else
      handler_.octets("body", body);
    extent(kFixedSize<Head>, body);
    handler_.leave();
  }
  void datum(std::string_view name, std::size_t index, const VariableDatum& item,
             std::span<const std::byte> all) {
    if (!handler_.enter(name, index, item)) return;
    FieldWalk inner(handler_);
    inner("variable_datum_id", item.datum_id);
    inner("variable_datum_length", item.length_bits);
    handler_.octets("variable_datum_value", item.value);
    // Includes the padding, which the last datum may lack.
    const std::size_t left = static_cast<std::size_t>(all.data() + all.size() - item.value.data());
    extent(2 * sizeof(std::uint32_t),
           {item.value.data(), std::min(padded_to(item.value.size(), 8), left)});
    handler_.leave();
  }
  void attribute_set(std::string_view name, std::size_t index, const AttributeSet& set) {
    if (!handler_.enter(name, index, set)) return;
    FieldWalk inner(handler_);
    inner("entity_id", set.entity_id);
    inner("number_of_attribute_records", set.count);
    constexpr std::string_view kRecords = "attribute_records";
    inner.list(kRecords);
    if constexpr (Handler::kExamples) {
      inner.record(kRecords, kNoIndex, HapticRecord{});
      inner.record(kRecords, kNoIndex, EnergyAccountRecord{});
      inner.record(kRecords, kNoIndex, OwnershipRecord{});
      inner.attribute_record(kRecords, kNoIndex, {});
    }
    std::size_t i = 0;
    for (const AttributeRecord& item : set.records()) {
      const auto typed = [&](const auto& value) {
        if (!handler_.enter(kRecords, i, value)) return;
        FieldWalk of_record(handler_, value);
        fields(of_record, value);
        extent(0, item.bytes);
        handler_.leave();
      };
      if (visit_attribute_record(item, typed) != DecodeError::none)
        inner.attribute_record(kRecords, i, item);
      ++i;
    }
    handler_.leave();
  }
  void attribute_record(std::string_view name, std::size_t index, const AttributeRecord& item) {
    if (!handler_.enter(name, index, item)) return;
    FieldWalk inner(handler_);
    inner("record_type", item.type);
    inner("record_length", item.length);
    handler_.octets("body", item.bytes.empty() ? item.bytes : item.body());
    extent(0, item.bytes);
    handler_.leave();
  }

  Handler& handler_;
  FieldMeanings meanings_;
};

}  // namespace reckon::pdu
