// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/diff/pdu_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <string_view>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/pdu/type_names.hpp"

namespace reckon::tools {
namespace {

using Octets = std::span<const std::byte>;

/// Limit of printed octets of a block; "..." replaces the rest.
constexpr std::size_t kMostHex = 16;

std::string hex_text(Octets octets) {
  std::string text;
  pdu::TextSink sink(text);
  pdu::put_hex(sink, octets.first(std::min(octets.size(), kMostHex)));
  if (octets.size() > kMostHex) text += fmt::format("... ({} octets)", octets.size());
  return text;
}

/// Visitor that steps through the fields of the first PDU and compares the same octets of the
/// second. Never reads beyond either.
class Comparer {
 public:
  Comparer(Octets a, Octets b, std::size_t most) : a_(a), b_(b), most_(most) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    const std::size_t outer = enter(name);
    if constexpr (pdu::Scalar<T>)
      scalar<T>();
    else if constexpr (pdu::kIsStdArray<T>)
      array(value);
    else
      fields(*this, value);
    path_.resize(outer);
  }
  template <typename Record, typename Count>
  void count(std::string_view name, Octets, pdu::Records<Record, Count>) {
    (*this)(name, Count{});
  }
  template <typename Record, typename Count>
  void records(std::string_view name, Octets view, pdu::Records<Record, Count>) {
    std::size_t number = 0;
    for (at_ = offset_of(view); !view.empty(); view = view.subspan(pdu::kFixedSize<Record>)) {
      const std::size_t outer = enter(fmt::format("{}[{}]", name, number++));
      record(view, Record{});
      path_.resize(outer);
    }
  }
  void walked(std::string_view name, const pdu::VariableDatums& datums) {
    std::size_t number = 0;
    for (const pdu::VariableDatum& datum : datums.records()) {
      at_ = offset_of(datum.value) - 8;
      const std::size_t outer = enter(fmt::format("{}[{}]", name, number++));
      (*this)("variable_datum_id", datum.datum_id);
      (*this)("variable_datum_length", datum.length_bits);
      block("variable_datum_value", datum.value);
      path_.resize(outer);
    }
    at_ = offset_of(datums.bytes) + datums.bytes.size();
  }
  void walked(std::string_view name, const pdu::AttributeRecordSets& sets) {
    pdu::Attribute pdu;
    pdu.record_sets = sets;
    std::size_t number = 0;
    for (const pdu::AttributeSet& set : pdu::AttributeReader(pdu)) {
      at_ = offset_of(set.bytes) - pdu::kAttributeSetHeaderSize;
      const std::size_t outer = enter(fmt::format("{}[{}]", name, number++));
      (*this)("entity_id", set.entity_id);
      (*this)("number_of_attribute_records", set.count);
      attribute_records(set);
      path_.resize(outer);
    }
    at_ = offset_of(sets.bytes) + sets.bytes.size();
  }
  template <pdu::OctetView View>
  void walked(std::string_view name, const View& view) {
    at_ = offset_of(view.bytes);
    block(name, view.value());
    at_ = offset_of(view.bytes) + view.bytes.size();
  }
  template <pdu::SizedView View>
  void walked(std::string_view name, const View& view) {
    std::size_t number = 0;
    for (const auto& item : view.records()) {
      using Head = typename View::Head;
      at_ = offset_of(item.body) - pdu::kFixedSize<Head>;
      const std::size_t outer = enter(fmt::format("{}[{}]", name, number++));
      fields(*this, item.head);
      if constexpr (pdu::HasParts<Head, Comparer>)
        parts(*this, item.head, item.body);
      else
        block("body", item.body);
      path_.resize(outer);
    }
    at_ = offset_of(view.bytes) + view.bytes.size();
  }

  /// The octets after all fields.
  void rest(std::string_view name) {
    const std::size_t begin = std::min(at_, std::max(a_.size(), b_.size()));
    compare(name, begin, std::max(a_.size(), b_.size()) - begin);
  }
  /// Differing octets that belong to no field, such as padding between records.
  void leftover() {
    if (!found_.empty()) return;
    const auto differ = std::ranges::mismatch(a_, b_);
    const auto at = static_cast<std::size_t>(differ.in1 - a_.begin());
    if (at < std::max(a_.size(), b_.size())) compare("padding", at, 1);
  }
  [[nodiscard]] std::vector<FieldDifference>& found() { return found_; }

 private:
  std::size_t enter(std::string_view name) {
    const std::size_t outer = path_.size();
    if (!path_.empty()) path_ += '.';
    path_ += name;
    return outer;
  }
  /// Offset of a view into the first PDU. An empty view may have any pointer and counts as the
  /// present offset.
  [[nodiscard]] std::size_t offset_of(Octets part) const {
    return part.empty() ? at_ : static_cast<std::size_t>(part.data() - a_.data());
  }
  [[nodiscard]] static Octets part(Octets whole, std::size_t at, std::size_t size) {
    return at >= whole.size() ? Octets() : whole.subspan(at, std::min(size, whole.size() - at));
  }
  /// Whether the octets differ and there is room for a finding.
  [[nodiscard]] bool differs(std::size_t at, std::size_t size) const {
    return found_.size() < most_ && !std::ranges::equal(part(a_, at, size), part(b_, at, size));
  }
  void tell(std::size_t at, std::size_t size, auto&& text) {
    const auto value = [&](Octets octets) {
      return octets.size() < size ? std::string("absent") : text(octets);
    };
    FieldDifference& difference = found_.emplace_back();
    difference = {path_, at, value(part(a_, at, size)), value(part(b_, at, size))};
    // NaN payloads, or letters after a NUL: the texts are equal, the octets are not.
    if (difference.a != difference.b) return;
    difference.a += " = 0x" + hex_text(part(a_, at, size));
    difference.b += " = 0x" + hex_text(part(b_, at, size));
  }
  template <typename T>
  void scalar() {
    if (differs(at_, sizeof(T))) {
      tell(at_, sizeof(T), [](Octets octets) {
        std::string text;
        pdu::TextSink sink(text);
        const T value = pdu::load_big_endian<T>(octets.data());
        if constexpr (std::is_enum_v<T>) {
          sink.number(static_cast<unsigned>(value));
          if (const std::string_view known = pdu::name(value); !known.empty())
            text += fmt::format(" ({})", known);
        } else {
          sink.number(value);
        }
        return text;
      });
    }
    at_ += sizeof(T);
  }
  template <typename T, std::size_t n>
  void array(const std::array<T, n>&) {
    if (differs(at_, n)) {
      tell(at_, n, [](Octets octets) {
        if constexpr (std::same_as<T, char>) {
          std::string text;
          pdu::TextSink sink(text);
          const std::string_view all(reinterpret_cast<const char*>(octets.data()), n);
          pdu::put_json_string(sink, all.substr(0, all.find('\0')));
          return text;
        } else {
          return hex_text(octets);
        }
      });
    }
    at_ += n;
  }
  void compare(std::string_view name, std::size_t at, std::size_t size) {
    const std::size_t outer = enter(name);
    if (differs(at, size)) {
      const auto text = [](Octets octets) {
        return octets.empty() ? std::string("absent") : hex_text(octets);
      };
      found_.push_back(
          {path_, first_difference(at, size), text(part(a_, at, size)), text(part(b_, at, size))});
    }
    path_.resize(outer);
  }
  [[nodiscard]] std::size_t first_difference(std::size_t at, std::size_t size) const {
    const Octets left = part(a_, at, size);
    const auto place = std::ranges::mismatch(left, part(b_, at, size));
    return at + static_cast<std::size_t>(place.in1 - left.begin());
  }
  void block(std::string_view name, Octets octets) {
    compare(name, at_, octets.size());
    at_ += octets.size();
  }
  void record(Octets octets, auto typed) {
    if (pdu::load_record(octets, typed)) fields(*this, typed);
  }
  void record(Octets octets, const pdu::VariableParameter&) {
    pdu::visit_variable_parameter(octets, [this](const auto& typed) { fields(*this, typed); });
  }
  void attribute_records(const pdu::AttributeSet& set) {
    std::size_t number = 0;
    for (const pdu::AttributeRecord& item : set.records()) {
      at_ = offset_of(item.bytes);
      const std::size_t outer = enter(fmt::format("attribute_records[{}]", number++));
      const auto typed = [this](const auto& value) { fields(*this, value); };
      if (pdu::visit_attribute_record(item, typed) != pdu::DecodeError::none) {
        (*this)("record_type", item.type);
        (*this)("record_length", item.length);
        block("body", item.body());
      }
      path_.resize(outer);
    }
  }

  Octets a_;
  Octets b_;
  std::size_t most_;
  std::size_t at_ = 0;
  std::string path_;
  std::vector<FieldDifference> found_;
};

}  // namespace

std::vector<FieldDifference> pdu_differences(std::span<const std::byte> a,
                                             std::span<const std::byte> b, std::size_t most) {
  if (std::ranges::equal(a, b)) return {};
  Comparer comparer(a, b, most);
  pdu::PduHeader header;
  pdu::PduHeader other;
  const bool readable = pdu::decode_header(a, header) == pdu::DecodeError::none &&
                        pdu::decode_header(b, other) == pdu::DecodeError::none;
  bool visited = false;
  if (readable && header.pdu_type == other.pdu_type)
    visited = pdu::visit(a, header, [&](const auto& pdu) { fields(comparer, pdu); }) ==
              pdu::DecodeError::none;
  if (visited) {
    comparer.rest("octets_behind_the_last_field");
  } else {
    if (readable) comparer("header", header);
    comparer.rest("body");
  }
  comparer.leftover();
  return std::move(comparer.found());
}

}  // namespace reckon::tools
