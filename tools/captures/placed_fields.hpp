// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Visits the fields of a PDU with their offsets, by its field table.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "reckon/pdu/pdu_types.hpp"

namespace reckon::tools {

/// Visitor of the field tables. Calls `see(name, value, at)` for each record and number of a PDU,
/// records before their parts, with the offset of its first octet; and `see.octets(name, view)` for
/// octets without fields.
template <typename See>
class PlacedFields {
 public:
  using Octets = std::span<const std::byte>;

  /// @param pdu its octets, into which the views of the visited value point
  PlacedFields(Octets pdu, See& see) : pdu_(pdu), see_(see) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    see_(name, value, at_);
    if constexpr (pdu::Scalar<T>)
      at_ += sizeof(T);
    else if constexpr (pdu::kIsStdArray<T>)
      at_ += value.size();
    else
      fields(*this, value);
  }
  template <typename Record, typename Count>
  void count(std::string_view, Octets, pdu::Records<Record, Count>) {
    at_ += sizeof(Count);
  }
  template <typename Record, typename Count>
  void records(std::string_view name, Octets view, pdu::Records<Record, Count>) {
    for (at_ = offset_of(view); !view.empty(); view = view.subspan(pdu::kFixedSize<Record>))
      record(name, view, Record{});
  }
  void walked(std::string_view name, const pdu::VariableDatums& datums) {
    for (const pdu::VariableDatum& datum : datums.records()) see_.octets(name, datum.value);
    at_ = offset_of(datums.bytes) + datums.bytes.size();
  }
  void walked(std::string_view name, const pdu::AttributeRecordSets& sets) {
    pdu::Attribute pdu;
    pdu.record_sets = sets;
    for (const pdu::AttributeSet& set : pdu::AttributeReader(pdu)) {
      at_ = offset_of(set.bytes) - pdu::kAttributeSetHeaderSize;
      (*this)("entity_id", set.entity_id);
      for (const pdu::AttributeRecord& item : set.records()) {
        at_ = offset_of(item.bytes);
        const auto typed = [this](const auto& value) { fields(*this, value); };
        if (pdu::visit_attribute_record(item, typed) != pdu::DecodeError::none)
          see_.octets(name, item.body());
      }
    }
    at_ = offset_of(sets.bytes) + sets.bytes.size();
  }
  template <pdu::OctetView View>
  void walked(std::string_view name, const View& view) {
    see_.octets(name, view.value());
    at_ = offset_of(view.bytes) + view.bytes.size();
  }
  template <pdu::SizedView View>
  void walked(std::string_view name, const View& view) {
    for (const auto& item : view.records()) {
      using Head = typename View::Head;
      at_ = offset_of(item.body) - pdu::kFixedSize<Head>;
      fields(*this, item.head);
      if constexpr (pdu::HasParts<Head, PlacedFields>)
        parts(*this, item.head, item.body);
      else
        see_.octets(name, item.body);
    }
    at_ = offset_of(view.bytes) + view.bytes.size();
  }

 private:
  /// An empty view that points elsewhere has the present offset.
  [[nodiscard]] std::size_t offset_of(Octets part) const {
    const std::less_equal<> before;
    const bool inside =
        before(pdu_.data(), part.data()) && before(part.data(), pdu_.data() + pdu_.size());
    return inside ? static_cast<std::size_t>(part.data() - pdu_.data()) : at_;
  }
  template <typename Record>
  void record(std::string_view name, Octets octets, Record typed) {
    if (pdu::load_record(octets, typed)) (*this)(name, typed);
  }
  void record(std::string_view name, Octets octets, const pdu::VariableParameter&) {
    pdu::visit_variable_parameter(octets, [&](const auto& typed) { (*this)(name, typed); });
  }

  Octets pdu_;
  See& see_;
  std::size_t at_ = 0;
};

}  // namespace reckon::tools
