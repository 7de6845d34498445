// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Places of the fields of a PDU or record, read from its field table, for a dissector in another
// language.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"

namespace reckon::tools {

/// One number, text or octet block at a fixed place.
struct FieldPlace {
  std::string path;  ///< "entity_location.x"
  std::size_t offset = 0;
  std::size_t size = 0;  ///< octets
  std::string type;      ///< u8 .. u64, i8 .. i64, f32, f64, text, octets
  /// For an enumeration of one octet: each value with a name.
  std::vector<std::pair<unsigned, std::string>> names{};
  bool is_pdu_type = false;
};

/// One variable part, in wire order.
struct BlockPlace {
  std::string kind;  ///< records, datums, octets, bits, attribute_sets, rest, other
  std::string name;
  FieldPlace count;                ///< field with the number of records; size 0 if none
  std::size_t size = 0;            ///< octets of one record of `records`
  std::vector<FieldPlace> fields;  ///< of one record of `records`; empty if its layout varies
};

/// Visitor that collects all places of one PDU or record.
class FieldLayout {
 public:
  template <typename T>
  void operator()(std::string_view name, const T& value) {
    const std::size_t outer = path_.size();
    enter(name);
    if constexpr (std::is_same_v<T, pdu::EntityId>) {
      if (!id_at_.has_value()) id_at_ = size_;
    }
    if constexpr (pdu::Scalar<T>) {
      place(&value, sizeof(T), type_name<T>());
      name_values<T>(fields_.back());
    } else if constexpr (pdu::kIsStdArray<T>) {
      place(&value, value.size(), std::is_same_v<typename T::value_type, char> ? "text" : "octets");
    } else {
      fields(*this, value);
    }
    path_.resize(outer);
  }
  template <typename Span, typename Record, typename Count>
  void count(std::string_view name, const Span& span, pdu::Records<Record, Count>) {
    const std::size_t outer = path_.size();
    enter(name);
    place(&span, sizeof(Count), type_name<Count>());
    path_.resize(outer);
  }
  template <typename Span, typename Record, typename Count>
  void records(std::string_view name, const Span& span, pdu::Records<Record, Count>) {
    BlockPlace block{"records", std::string(name), counted(&span), pdu::kFixedSize<Record>, {}};
    // The layout of a variable parameter depends on its first octet.
    if constexpr (!std::is_same_v<Record, pdu::VariableParameter>) {
      FieldLayout inner;
      const Record record{};
      fields(inner, record);
      block.fields = inner.fields_;
    }
    blocks_.push_back(std::move(block));
  }
  template <typename View>
  void walked(std::string_view name, const View& view) {
    BlockPlace block{kind_of<View>(), std::string(name), {}, 0, {}};
    if constexpr (!std::is_same_v<View, pdu::RestOfPdu>) block.count = counted(&view.count);
    blocks_.push_back(std::move(block));
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const std::vector<FieldPlace>& places() const { return fields_; }
  [[nodiscard]] const std::vector<BlockPlace>& blocks() const { return blocks_; }
  /// Offset of the first EntityId.
  [[nodiscard]] std::optional<std::size_t> id_at() const { return id_at_; }

 private:
  void enter(std::string_view name) {
    if (!path_.empty()) path_ += '.';
    path_ += name;
  }
  void place(const void* value, std::size_t size, std::string type) {
    counts_[value] = fields_.size();
    fields_.push_back({path_, size_, size, std::move(type), {}, false});
    size_ += size;
  }
  [[nodiscard]] FieldPlace counted(const void* value) const {
    const auto found = counts_.find(value);
    return found == counts_.end() ? FieldPlace{} : fields_[found->second];
  }
  template <typename View>
  static std::string kind_of() {
    if constexpr (std::is_same_v<View, pdu::VariableDatums>) return "datums";
    if constexpr (std::is_same_v<View, pdu::AttributeRecordSets>) return "attribute_sets";
    if constexpr (std::is_same_v<View, pdu::RestOfPdu>) return "rest";
    if constexpr (pdu::OctetView<View>) return std::string(View::kUnit);
    return "other";
  }
  template <typename T>
  static std::string type_name() {
    const std::string bits = std::to_string(8 * sizeof(T));
    if constexpr (std::is_floating_point_v<T>) return "f" + bits;
    return (std::is_signed_v<T> ? "i" : "u") + bits;
  }
  template <typename T>
  static void name_values(FieldPlace& field) {
    if constexpr (std::is_same_v<T, pdu::PduType>) {
      field.is_pdu_type = true;
    } else if constexpr (std::is_enum_v<T> && sizeof(T) == 1) {
      for (unsigned value = 0; value < 256; ++value) {
        const std::string_view text = name(static_cast<T>(value));
        if (!text.empty()) field.names.emplace_back(value, text);
      }
    }
  }

  std::string path_;
  std::size_t size_ = 0;
  std::vector<FieldPlace> fields_;
  std::vector<BlockPlace> blocks_;
  std::map<const void*, std::size_t> counts_;  // place of the field at this address
  std::optional<std::size_t> id_at_;
};

template <typename T>
[[nodiscard]] FieldLayout layout_of() {
  FieldLayout layout;
  const T value{};
  fields(layout, value);
  return layout;
}

}  // namespace reckon::tools
