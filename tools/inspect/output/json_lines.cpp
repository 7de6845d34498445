// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/output/json_lines.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <concepts>
#include <span>

#include "reckon/pdu/geodetic.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/tools/datagrams/first_location.hpp"
#include "reckon/tools/datagrams/ownership_text.hpp"
#include "reckon/tools/datagrams/restored_states.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::tools {
namespace {

/// Appends a key (with everything before the number) and a whole number.
void append_member(std::string& out, std::string_view key, std::uint64_t value) {
  out += key;
  append_number(out, value);
}

/// Metres to the millimetre; null for a number that JSON lacks.
void append_millimetres(std::string& out, double metres) {
  if (std::isfinite(metres))
    append_thousandths(out, metres);
  else
    out += "null";
}

void append_entity_state(std::string& out, const pdu::EntityState& pdu) {
  pdu::TextSink sink(out);
  out += ",\"marking\":";
  pdu::put_json_string(sink, pdu.marking.view());
  append_member(out, ",\"force_id\":", static_cast<unsigned>(pdu.force_id));
}

/// Degrees to 9 decimals, within 360; null for a number that JSON lacks.
void append_degrees(std::string& out, double degrees) {
  if (!std::isfinite(degrees)) {
    out += "null";
    return;
  }
  constexpr std::int64_t kScale = 1'000'000'000;
  const std::int64_t scaled = std::llround(degrees * static_cast<double>(kScale));
  append_time(out, std::chrono::nanoseconds(scaled));
}

/// Location of the PDU, geocentric and geodetic; with `full` also the orientation of its entity.
void append_place(std::string& out, const PduRow& row, bool full) {
  const auto location = first_location(row);
  if (!location.has_value()) return;
  out += ",\"location\":[";
  append_millimetres(out, location->x);
  out += ',';
  append_millimetres(out, location->y);
  out += ',';
  append_millimetres(out, location->z);
  out += ']';
  const auto place = pdu::geodetic_from(*location);
  if (!place.has_value()) return;
  out += ",\"latitude\":";
  append_degrees(out, place->latitude_deg);
  out += ",\"longitude\":";
  append_degrees(out, place->longitude_deg);
  out += ",\"height\":";
  append_millimetres(out, place->height);
  if (!full || row.entity_state == nullptr) return;
  const auto attitude = pdu::attitude_from(row.entity_state->orientation, *place);
  if (!attitude.has_value()) return;
  fmt::format_to(end_of(out), FMT_COMPILE(",\"heading\":{:.4f},\"pitch\":{:.4f},\"roll\":{:.4f}"),
                 attitude->heading_deg, attitude->pitch_deg, attitude->roll_deg);
}

/// The records of one type in an Attribute PDU, as an array under `key`; nothing if there are none.
template <typename Record>
void append_records(std::string& out, std::string_view key, const pdu::Attribute& pdu) {
  bool first = true;
  for (const pdu::AttributeSet& set : pdu::AttributeReader(pdu)) {
    for (const pdu::AttributeRecord& attribute : set.records()) {
      Record record;
      if (attribute.type != Record::kType || decode(attribute, record) != pdu::DecodeError::none)
        continue;
      if (first)
        fmt::format_to(end_of(out), FMT_COMPILE(",\"{}\":["), key);
      else
        out += ',';
      first = false;
      fmt::format_to(end_of(out), FMT_COMPILE("{{\"id\":\"{}:{}:{}\","), set.entity_id.site,
                     set.entity_id.application, set.entity_id.entity);
      pdu::TextSink sink(out);
      pdu::JsonFields members(sink);
      fields(members, record);
      out += '}';
    }
  }
  if (!first) out += ']';
}

/// Every field of a PDU. Most PDUs are shorter than the buffer, which takes text faster than a
/// string.
void append_fields(std::string& out, const auto& pdu) {
  out += ",\"fields\":";
  std::array<char, 32 * 1024> buffer;
  pdu::TextSink quick{std::span<char>(buffer)};
  pdu::print_named_json(pdu, quick);
  if (!quick.truncated()) {
    out += quick.view();
    return;
  }
  pdu::TextSink sink(out);
  pdu::print_named_json(pdu, sink);
}

/// The states of Compressed States, or the reason why one cannot be restored.
void append_states(std::string& out, const std::vector<RestoredState>& states, bool full);

void append_body(std::string& out, const PduRow& row, bool full) {
  if (row.entity_state != nullptr) append_entity_state(out, *row.entity_state);
  append_place(out, row, full);
  if (row.entity_state != nullptr)
    append_member(out,
                  ",\"drm\":", static_cast<unsigned>(row.entity_state->dead_reckoning.algorithm));
  if (row.restored != nullptr) append_states(out, *row.restored, full);
  if (may_be_about_owners(row.header.pdu_type)) {
    const std::string text = ownership_text(row.bytes);
    if (!text.empty()) append_json_member(out, "about_owners", text);
  }
  if (!full && row.header.pdu_type != pdu::PduType::attribute) return;
  (void)pdu::visit(row.bytes, row.header, [&]<typename Pdu>(const Pdu& pdu) {
    if constexpr (std::same_as<Pdu, pdu::Attribute>) {
      append_records<pdu::HapticRecord>(out, "haptic", pdu);
      append_records<pdu::EnergyAccountRecord>(out, "energy", pdu);
      append_records<pdu::OwnershipRecord>(out, "ownership", pdu);
    }
    if (full) append_fields(out, pdu);
  });
}

void append_states(std::string& out, const std::vector<RestoredState>& states, bool full) {
  out += ",\"states\":[";
  std::string_view before;
  for (const RestoredState& state : states) {
    out += before;
    out += "{\"id\":\"";
    append_id(out, *state.row.id);
    append_member(out, "\",\"offset\":", state.row.offset);
    append_member(out, ",\"octets\":", state.octets);
    append_json_member(out, "form", pdu::name(state.form));
    if (state.row.decoded)
      append_body(out, state.row, full);
    else
      append_json_member(out, "reason", state.row.reason);
    out += '}';
    before = ",";
  }
  out += ']';
}

/// A PDU whose body cannot be read: the header, and the rest in hexadecimal.
void append_raw_fields(std::string& out, const PduRow& row) {
  out += ",\"fields\":";
  pdu::TextSink sink(out);
  if (row.has_header) {
    (void)pdu::print_pdu_json(row.bytes, sink);
    return;
  }
  sink.text("{\"body\":\"");
  pdu::put_hex(sink, row.bytes);
  sink.text("\"}");
}

}  // namespace

void append_json_line(std::string& out, const PduRow& row, bool full) {
  append_member(out, "{\"frame\":", row.frame);
  append_member(out, ",\"pdu\":", row.pdu);
  append_member(out, ",\"offset\":", row.offset);
  out += ",\"time\":";
  append_time(out, row.time);
  if (!row.interface.empty()) {
    out += ",\"interface\":";
    pdu::TextSink sink(out);
    pdu::put_json_string(sink, row.interface);
  }
  out += ",\"type\":\"";
  out += row.type();
  append_member(out, "\",\"type_number\":", static_cast<unsigned>(row.header.pdu_type));
  append_member(out, ",\"length\":", row.header.length);
  out += ",\"status\":\"";
  out += name(row.status);
  out += '"';
  if (row.status != PduStatus::ok) {
    fmt::format_to(end_of(out), FMT_COMPILE(",\"rule\":\"{}\",\"reason\":"), row.rule);
    pdu::TextSink sink(out);
    pdu::put_json_string(sink, row.reason);
    fmt::format_to(end_of(out), FMT_COMPILE(",\"at\":{}"), row.fault_offset);
  }
  if (row.id.has_value()) {
    out += ",\"id\":\"";
    append_id(out, *row.id);
    out += '"';
  }
  if (row.decoded)
    append_body(out, row, full);
  else if (full)
    append_raw_fields(out, row);
  out += "}\n";
}

}  // namespace reckon::tools
