// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/print.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace reckon::pdu {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";

void put_hex_octet(TextSink& sink, unsigned octet) {
  sink.text(kHexDigits[octet >> 4]);
  sink.text(kHexDigits[octet & 15U]);
}

// Whether a character stands for itself in a JSON string.
bool is_unescaped(char c) { return c >= 0x20 && c <= 0x7E && c != '"' && c != '\\'; }

// The octets of a PDU without a field table, or of a damaged one: header and the rest.
struct RawPdu {
  PduHeader header;
  std::span<const std::byte> body;
};

RawPdu raw_pdu(std::span<const std::byte> octets) {
  RawPdu raw;
  static_cast<void>(decode_header(octets, raw.header));
  raw.body = octets.subspan(std::min(octets.size(), kHeaderSize));
  return raw;
}

void raw_fields(auto& print, const RawPdu& raw) {
  print("header", raw.header);
  print.hex("body", raw.body);
}

// Visitor: reads a damaged PDU and prints its fields. It stops at the first field beyond the end of
// the octets, or at the first variable part, because the fault is then in it. The remaining octets
// are printed as "rest".
template <typename Print>
class FieldsUpToFault {
 public:
  FieldsUpToFault(Print& print, std::span<const std::byte> octets) : print_(print), rest_(octets) {}

  template <typename T>
  void operator()(std::string_view name, T& value) {
    if (has_ended_ || kWireSize < T >> rest_.size()) {
      has_ended_ = true;
      return;
    }
    Decoder decoder(rest_.first(kWireSize<T>));
    decoder(name, value);
    rest_ = rest_.subspan(kWireSize<T>);
    print_(name, std::as_const(value));
  }
  template <typename Record, typename Count>
  void count(std::string_view name, std::span<const std::byte>&, Records<Record, Count>) {
    Count number{};
    (*this)(name, number);
  }
  template <typename Record, typename Count>
  void records(std::string_view, std::span<const std::byte>&, Records<Record, Count>) {
    has_ended_ = true;
  }
  template <typename View>
  void walked(std::string_view, View&) {
    has_ended_ = true;
  }
  void finish() { print_.hex("rest", rest_); }

 private:
  Print& print_;
  std::span<const std::byte> rest_;
  bool has_ended_ = false;
};

// False if the type has no field table.
template <typename Print, typename... T>
bool fields_up_to_fault(Print& print, std::span<const std::byte> octets, PduType type,
                        TypeList<T...>) {
  const auto attempt = [&]<typename Candidate>(std::type_identity<Candidate>) {
    if (Candidate::kPduType != type) return false;
    FieldsUpToFault<Print> visitor(print, octets);
    Candidate pdu;
    fields(visitor, pdu);
    visitor.finish();
    return true;
  };
  return (attempt(std::type_identity<T>{}) || ...);
}

// Prints a PDU that cannot be decoded: its readable fields, and the rest as octets.
void damaged_fields(auto& print, std::span<const std::byte> octets, DecodeError error) {
  const RawPdu raw = raw_pdu(octets);
  const bool has_fields = octets.size() >= kHeaderSize && error != DecodeError::version &&
                          is_supported_version(raw.header.protocol_version);
  if (has_fields && fields_up_to_fault(print, octets, raw.header.pdu_type, PduTypes{})) return;
  raw_fields(print, raw);
}

DecodeError print_octets(std::span<const std::byte> octets, auto&& print) {
  PduHeader header;
  const DecodeError error = decode_header(octets, header);
  return error != DecodeError::none ? error : visit(octets, header, print);
}

/// Calls `f(field, value)` for each bit field to be shown.
void each_bit_field(SisoBits set, std::uint32_t word, auto&& f) {
  for (std::size_t i = 0; i < siso_size(set); ++i) {
    const SisoBitField field = siso_bit_field(set, i);
    const std::uint32_t value = field.of(word);
    if (value != 0 || shows_zeros(set)) f(field, value);
  }
}

void put_word(TextSink& sink, std::string_view what, SisoTable table, std::uint32_t value) {
  const std::string_view name = siso_name(table, value);
  if (name.empty()) {
    sink.text(what);
    sink.text(' ');
    sink.number(value);
  } else {
    sink.text(name);
  }
}

}  // namespace

void put_type_in_words(TextSink& sink, const EntityType& type) {
  put_word(sink, "kind", SisoTable::entity_kind, static_cast<unsigned>(type.kind));
  sink.text(' ');
  put_word(sink, "domain", domain_table(type.kind), static_cast<unsigned>(type.domain));
  if (type.country != 0) {
    sink.text(' ');
    put_word(sink, "country", SisoTable::country, type.country);
  }
  if (type.category != 0) {
    sink.text(' ');
    put_word(sink, "category", category_table(type.kind, type.domain), type.category);
  }
}

void put_json_string(TextSink& sink, std::string_view text) {
  sink.text('"');
  while (!text.empty()) {
    const auto plain =
        static_cast<std::size_t>(std::ranges::find_if_not(text, is_unescaped) - text.begin());
    sink.text(text.substr(0, plain));
    if (plain == text.size()) break;
    const char c = text[plain];
    text.remove_prefix(plain + 1);
    if (c == '"' || c == '\\') {
      sink.text('\\');
      sink.text(c);
    } else {
      sink.text("\\u00");
      put_hex_octet(sink, static_cast<unsigned char>(c));
    }
  }
  sink.text('"');
}

void put_hex(TextSink& sink, std::span<const std::byte> octets) {
  for (const std::byte octet : octets) put_hex_octet(sink, std::to_integer<unsigned>(octet));
}

void JsonFields::hex(std::string_view name, std::span<const std::byte> octets) {
  key(name);
  sink_.text('"');
  put_hex(sink_, octets);
  sink_.text('"');
}

void JsonFields::member(std::string_view field, std::string_view ending, std::string_view text) {
  sink_.text(",\"");
  sink_.text(field);
  sink_.text(ending);
  sink_.text("\":");
  put_json_string(sink_, text);
}

void JsonFields::readings(std::string_view field, const FieldReadings& of_value) {
  FieldReadings of_field;
  meanings_.read(field, of_field);
  const auto parts = of_field.parts().empty() ? of_value.parts() : of_field.parts();
  if (parts.empty()) return;
  sink_.text(",\"");
  sink_.text(field);
  sink_.text("_read\":{");
  for (const FieldReading& part : parts) {
    if (&part != parts.data()) sink_.text(',');
    sink_.text('"');
    sink_.text(part.key);
    if (!part.unit.empty()) sink_.text('_');
    sink_.text(part.unit);
    sink_.text("\":");
    part.unit.empty() ? put_json_string(sink_, part.view()) : sink_.text(part.view());
  }
  sink_.text('}');
}

void JsonFields::bits(std::string_view field, SisoBits set, std::uint32_t word) {
  bool first = true;
  each_bit_field(set, word, [&](const SisoBitField& part, std::uint32_t value) {
    if (first) {
      sink_.text(",\"");
      sink_.text(field);
      sink_.text("_bits\":{\"");
    } else {
      sink_.text(",\"");
    }
    first = false;
    sink_.text(part.name);
    sink_.text("\":");
    const std::string_view name = siso_name(part.values, value);
    name.empty() ? sink_.number(value) : put_json_string(sink_, name);
  });
  if (!first) sink_.text('}');
}

void JsonFields::walked(std::string_view name, const VariableDatums& datums) {
  key(name);
  list(datums.records(), [this](const VariableDatum& datum) {
    sink_.text('{');
    JsonFields members = part();
    members("variable_datum_id", datum.datum_id);
    members("variable_datum_length", datum.length_bits);
    members.hex("variable_datum_value", datum.value);
    const std::string_view text = named_ ? text_in(datum.value) : std::string_view();
    if (!text.empty()) members.member("variable_datum", "_text", text);
    sink_.text('}');
  });
}

void JsonFields::walked(std::string_view name, const AttributeRecordSets& sets) {
  Attribute pdu;
  pdu.record_sets = sets;
  key(name);
  list(AttributeReader(pdu), [this](const AttributeSet& set) {
    sink_.text('{');
    JsonFields members = part();
    members("entity_id", set.entity_id);
    members("number_of_attribute_records", set.count);
    members.key("attribute_records");
    list(set.records(), [this](const AttributeRecord& item) { attribute_record(item); });
    sink_.text('}');
  });
}

void JsonFields::attribute_record(const AttributeRecord& item) {
  const auto typed = [this](const auto& value) { object(value); };
  if (visit_attribute_record(item, typed) == DecodeError::none) return;
  sink_.text('{');
  JsonFields members = part();
  members("record_type", item.type);
  members("record_length", item.length);
  members.hex("body", item.body());
  sink_.text('}');
}

void TreeFields::in_parentheses(std::string_view text) {
  if (text.empty()) return;
  sink_.text(" (");
  sink_.text(text);
  sink_.text(')');
}

void TreeFields::readings(std::string_view field, const FieldReadings& of_value) {
  FieldReadings of_field;
  meanings_.read(field, of_field);
  const auto parts = of_field.parts().empty() ? of_value.parts() : of_field.parts();
  for (const FieldReading& part : parts) {
    sink_.text(&part == parts.data() ? " (" : ", ");
    sink_.text(part.key);
    sink_.text(' ');
    sink_.text(part.view());
    if (!part.unit.empty()) sink_.text(' ');
    sink_.text(part.unit);
  }
  if (!parts.empty()) sink_.text(')');
}

void TreeFields::bits(SisoBits set, std::uint32_t word) {
  bool first = true;
  each_bit_field(set, word, [&](const SisoBitField& field, std::uint32_t value) {
    const std::string_view name = siso_name(field.values, value);
    if (inline_) {
      sink_.text(first ? " (" : ", ");
      sink_.text(field.name);
      sink_.text(' ');
      name.empty() ? sink_.number(value) : sink_.text(name);
    } else {
      sink_.text('\n');
      for (std::size_t i = 0; i <= depth_; ++i) sink_.text("  ");
      sink_.text(field.name);
      sink_.text(' ');
      sink_.number(value);
      in_parentheses(name);
    }
    first = false;
  });
  if (inline_ && !first) sink_.text(')');
}

void TreeFields::start(std::string_view name) {
  if (inline_) {
    sink_.text(' ');
  } else {
    for (std::size_t i = 0; i < depth_; ++i) sink_.text("  ");
  }
  sink_.text(name);
}

void TreeFields::hex(std::string_view name, std::span<const std::byte> octets) {
  start(name);
  sink_.text(' ');
  put_hex(sink_, octets);
  if (!inline_) sink_.text('\n');
}

void TreeFields::walked(std::string_view name, const VariableDatums& datums) {
  for (const VariableDatum& datum : datums.records()) {
    start(name);
    TreeFields inner(sink_, depth_ + 1, true);
    inner("variable_datum_id", datum.datum_id);
    inner("variable_datum_length", datum.length_bits);
    inner.hex("variable_datum_value", datum.value);
    if (const std::string_view text = text_in(datum.value); !text.empty()) {
      sink_.text(" (text ");
      put_json_string(sink_, text);
      sink_.text(')');
    }
    sink_.text('\n');
  }
}

void TreeFields::walked(std::string_view name, const AttributeRecordSets& sets) {
  Attribute pdu;
  pdu.record_sets = sets;
  for (const AttributeSet& set : AttributeReader(pdu)) {
    (*this)(name, set.entity_id);
    TreeFields inner(sink_, depth_ + 1, false);
    for (const AttributeRecord& item : set.records()) inner.attribute_record(item);
  }
}

void TreeFields::attribute_record(const AttributeRecord& item) {
  const auto typed = [this](const auto& value) { (*this)("attribute_record", value); };
  if (visit_attribute_record(item, typed) == DecodeError::none) return;
  start("attribute_record");
  TreeFields line(sink_, 0, true);
  line("record_type", item.type);
  line("record_length", item.length);
  line.hex("body", item.body());
  sink_.text('\n');
}

DecodeError print_pdu_json(std::span<const std::byte> pdu, TextSink& sink) {
  const DecodeError error = print_octets(pdu, [&](const auto& typed) { print_json(typed, sink); });
  if (error != DecodeError::none) {
    sink.text('{');
    JsonFields json(sink);
    damaged_fields(json, pdu, error);
    sink.text('}');
  }
  return error;
}

DecodeError print_pdu_tree(std::span<const std::byte> pdu, TextSink& sink) {
  const DecodeError error = print_octets(pdu, [&](const auto& typed) { print_tree(typed, sink); });
  if (error != DecodeError::none) {
    TreeFields tree(sink, 0, false);
    damaged_fields(tree, pdu, error);
  }
  return error;
}

}  // namespace reckon::pdu
