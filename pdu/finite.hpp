// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Search for NaN and infinity in a decoded PDU. Decoding keeps such values, because an inspector
// must show them. Code that computes with a received PDU must check it here first.
#pragma once

#include <cmath>
#include <span>
#include <string_view>
#include <type_traits>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/codec/sized_records.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"
#include "reckon/pdu/management/datum.hpp"

namespace reckon::pdu {

/// Visitor: stores the name of the first field that is not finite.
class FiniteCheck {
 public:
  template <typename T>
  void operator()(std::string_view name, const T& value) noexcept {
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value) && first_.empty()) first_ = name;
    } else if constexpr (!Scalar<T> && !kIsStdArray<T>) {
      const bool finite = first_.empty();
      fields(*this, value);
      // "entity_location" is more useful than "x".
      if (finite && !first_.empty()) first_ = name;
    }
  }
  template <typename Span, typename R>
  void count(std::string_view, const Span&, R) noexcept {}
  template <typename Record, typename Count>
  void records(std::string_view name, std::span<const std::byte> view,
               Records<Record, Count>) noexcept {
    if constexpr (std::is_same_v<Record, VariableParameter>) {
      for (; !view.empty(); view = view.subspan(kVariableParameterSize))
        visit_variable_parameter(view, [&](const auto& record) { (*this)(name, record); });
    } else {
      for (const Record& record : records_of<Record>(view)) (*this)(name, record);
    }
  }
  void walked(std::string_view, const VariableDatums&) noexcept {}
  void walked(std::string_view name, const AttributeRecordSets& sets) noexcept {
    Attribute pdu;
    pdu.record_sets = sets;
    for (const AttributeSet& set : AttributeReader(pdu)) {
      for (const AttributeRecord& record : set.records())
        static_cast<void>(
            visit_attribute_record(record, [&](const auto& typed) { (*this)(name, typed); }));
    }
  }
  template <OctetView View>
  void walked(std::string_view, const View&) noexcept {}
  template <SizedView View>
  void walked(std::string_view name, const View& view) noexcept {
    for (const auto& item : view.records()) {
      (*this)(name, item.head);
      if constexpr (HasParts<typename View::Head, FiniteCheck>) parts(*this, item.head, item.body);
    }
  }

  [[nodiscard]] std::string_view first() const noexcept { return first_; }

 private:
  std::string_view first_;
};

/// The name of the first field of `value` (a PDU or a record) with NaN or infinity; "" if all are
/// finite. Includes variable parameters of known kinds, and haptic and energy records.
[[nodiscard]] std::string_view first_not_finite(const auto& value) noexcept {
  FiniteCheck check;
  fields(check, value);
  return check.first();
}

[[nodiscard]] bool all_finite(const auto& value) noexcept {
  return first_not_finite(value).empty();
}

}  // namespace reckon::pdu
