// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "pdu/print.hpp"

namespace reckon::pdu {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";

void put_hex_octet(TextSink& sink, unsigned octet) {
  sink.text(kHexDigits[octet >> 4]);
  sink.text(kHexDigits[octet & 15U]);
}

// The octets of a PDU that has no field table, or is damaged: header and the rest as they are.
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

template <typename Visitor>
void raw_fields(Visitor& visitor, const RawPdu& raw) {
  visitor("header", raw.header);
  visitor.hex("body", raw.body);
}

template <typename Print>
DecodeError print_octets(std::span<const std::byte> octets, Print&& print) {
  PduHeader header;
  const DecodeError error = decode_header(octets, header);
  return error != DecodeError::none ? error : visit(octets, header, print);
}

}  // namespace

void put_json_string(TextSink& sink, std::string_view text) {
  sink.text('"');
  for (const char c : text) {
    const auto octet = static_cast<unsigned char>(c);
    if (octet < 0x20 || octet > 0x7E) {
      sink.text("\\u00");
      put_hex_octet(sink, octet);
    } else {
      if (c == '"' || c == '\\') sink.text('\\');
      sink.text(c);
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

void JsonFields::walked(std::string_view name, const VariableDatums& datums) {
  key(name);
  sink_.text('[');
  bool first = true;
  for (const VariableDatum& datum : datums.records()) {
    sink_.text(first ? "{" : ",{");
    first = false;
    JsonFields inner(sink_);
    inner("variable_datum_id", datum.datum_id);
    inner("variable_datum_length", datum.length_bits);
    inner.hex("variable_datum_value", datum.value);
    sink_.text('}');
  }
  sink_.text(']');
}

void JsonFields::walked(std::string_view name, const AttributeRecordSets& sets) {
  Attribute pdu;
  pdu.record_sets = sets;
  key(name);
  sink_.text('[');
  bool first_set = true;
  for (const AttributeSet& set : AttributeReader(pdu)) {
    sink_.text(first_set ? "{" : ",{");
    first_set = false;
    JsonFields members(sink_);
    members("entity_id", set.entity_id);
    members("number_of_attribute_records", set.count);
    members.key("attribute_records");
    sink_.text('[');
    bool first = true;
    for (const AttributeRecord& record : set.records()) {
      if (!first) sink_.text(',');
      first = false;
      const auto typed = [this](const auto& value) { object(value); };
      if (visit_attribute_record(record, typed) == DecodeError::none) continue;
      sink_.text('{');
      JsonFields inner(sink_);
      inner("record_type", record.type);
      inner("record_length", record.length);
      inner.hex("body", record.body());
      sink_.text('}');
    }
    sink_.text("]}");
  }
  sink_.text(']');
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
    sink_.text('\n');
  }
}

void TreeFields::walked(std::string_view name, const AttributeRecordSets& sets) {
  Attribute pdu;
  pdu.record_sets = sets;
  for (const AttributeSet& set : AttributeReader(pdu)) {
    (*this)(name, set.entity_id);
    TreeFields inner(sink_, depth_ + 1, false);
    for (const AttributeRecord& record : set.records()) {
      const auto typed = [&](const auto& value) { inner("attribute_record", value); };
      if (visit_attribute_record(record, typed) == DecodeError::none) continue;
      inner.start("attribute_record");
      TreeFields line(sink_, 0, true);
      line("record_type", record.type);
      line("record_length", record.length);
      line.hex("body", record.body());
      sink_.text('\n');
    }
  }
}

DecodeError print_pdu_json(std::span<const std::byte> pdu, TextSink& sink) {
  const DecodeError error = print_octets(pdu, [&](const auto& typed) { print_json(typed, sink); });
  if (error != DecodeError::none) {
    sink.text('{');
    JsonFields json(sink);
    raw_fields(json, raw_pdu(pdu));
    sink.text('}');
  }
  return error;
}

DecodeError print_pdu_tree(std::span<const std::byte> pdu, TextSink& sink) {
  const DecodeError error = print_octets(pdu, [&](const auto& typed) { print_tree(typed, sink); });
  if (error != DecodeError::none) {
    TreeFields tree(sink, 0, false);
    raw_fields(tree, raw_pdu(pdu));
  }
  return error;
}

}  // namespace reckon::pdu
