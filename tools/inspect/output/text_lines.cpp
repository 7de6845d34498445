// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/output/text_lines.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <concepts>

#include "reckon/pdu/geodetic.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/tools/command_line/duration_text.hpp"
#include "reckon/tools/datagrams/ownership_text.hpp"
#include "reckon/tools/datagrams/restored_states.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::tools {
namespace {

void append_fault(std::string& out, const PduRow& row, bool colour) {
  if (colour) out += colour_of(row.status);
  fmt::format_to(end_of(out), FMT_COMPILE("{} at +{}"), row.rule, row.fault_offset);
  if (colour) out += "\x1b[0m";
  out += ": ";
  out += row.reason;
}

/// A marking may have any octets: octets other than printable ASCII become dots.
void append_printable(std::string& out, std::string_view text) {
  for (const char letter : text) out += letter < ' ' || letter > '~' ? '.' : letter;
}

/// Appends the name of a value, or its kind and number if it has none: "Friendly", "side 77".
void append_name(std::string& out, std::string_view what, auto value) {
  const std::string_view name = pdu::name(value);
  out += name.empty() ? what : name;
  if (!name.empty()) return;
  out += ' ';
  append_number(out, static_cast<unsigned>(value));
}

/// |value| with 7 decimals, for |value| of at most 360; faster than fmt.
void append_degrees(std::string& out, double value) {
  constexpr std::uint64_t kUnits = 10'000'000;
  const auto units = static_cast<std::uint64_t>(std::abs(value) * double{kUnits} + 0.5);
  append_number(out, units / kUnits);
  const fmt::format_int decimals(units % kUnits + kUnits);  // a leading 1 keeps the zeros
  out += '.';
  out.append(decimals.data() + 1, decimals.size() - 1);
}

/// "47.1234567 N 8.1234567 E 412.345 m".
void append_place(std::string& out, const pdu::Geodetic& place) {
  append_degrees(out, place.latitude_deg);
  out += place.latitude_deg < 0 ? " S " : " N ";
  append_degrees(out, place.longitude_deg);
  out += place.longitude_deg < 0 ? " W " : " E ";
  append_thousandths(out, place.height);
  out += " m";
}

/// "sent 41:15.999999 absolute": the timestamp, past the hour.
void append_timestamp(std::string& out, const pdu::PduHeader& header) {
  out += "  sent ";
  pdu::TextSink sink(out);
  pdu::put_past_the_hour(sink, header.timestamp);
  out += pdu::is_absolute(header.timestamp) ? " absolute" : " relative";
}

void append_entity_state(std::string& out, const pdu::EntityState& pdu) {
  append_printable(out, pdu.marking.view());
  out += "  ";
  pdu::TextSink sink(out);
  pdu::put_type_in_words(sink, pdu.entity_type);
  out += "  ";
  append_name(out, "side", pdu.force_id);
  out += "  ";
  append_name(out, "DRM", pdu.dead_reckoning.algorithm);
  std::string_view before = "  (";
  for (const double metres : {pdu.location.x, pdu.location.y, pdu.location.z}) {
    out += before;
    append_thousandths(out, metres);
    before = ", ";
  }
  out += ") m";
  if (const auto place = pdu::geodetic_from(pdu.location)) {
    out += "  ";
    append_place(out, *place);
  }
  if (!pdu.variable_parameters.empty())
    fmt::format_to(end_of(out), "  {} variable parameters",
                   pdu.variable_parameters.size() / pdu::kVariableParameterSize);
  if (pdu.header.coupled_extension()) out += "  CEI";
}

void append_record(std::string& out, const pdu::HapticRecord& record) {
  const std::string_view kind = pdu::name(record.kind);
  fmt::format_to(end_of(out), "{} k1 {} N/m", kind.empty() ? "force model" : kind, record.k1);
  if (record.k3 != 0.0F) fmt::format_to(end_of(out), " k3 {} N/m3", record.k3);
  fmt::format_to(end_of(out), " b {} N s/m mu {}/{} r {} m valid {}", record.damping,
                 record.static_friction, record.kinetic_friction, record.radius,
                 duration_text(std::chrono::milliseconds(record.validity_ms)));
}

void append_record(std::string& out, const pdu::EnergyAccountRecord& record) {
  fmt::format_to(end_of(out), "gave {} {:.6g} J, needs {:.6g} J", id_text(record.counterpart),
                 record.given, pdu::from_microjoules(record.need));
}

void append_record(std::string& out, const pdu::OwnershipRecord& record) {
  fmt::format_to(end_of(out), "owner {:08x}, version {}, {}", record.owner,
                 version_text(record.version), cause_text(record.version));
}

void append_attribute(std::string& out, const pdu::Attribute& pdu) {
  std::size_t records = 0;
  std::string ours;
  for (const pdu::AttributeSet& set : pdu::AttributeReader(pdu)) {
    records += set.count;
    for (const pdu::AttributeRecord& record : set.records()) {
      (void)pdu::visit_attribute_record(record, [&](const auto& typed) {
        ours += "; ";  // with one set, the ID column shows the entity
        if (pdu.record_sets.count > 1) ours += id_text(set.entity_id) + ": ";
        append_record(ours, typed);
      });
    }
  }
  fmt::format_to(end_of(out), "{} set{}, {} record{}", pdu.record_sets.count,
                 pdu.record_sets.count == 1 ? "" : "s", records, records == 1 ? "" : "s");
  out += ours;
}

/// Visitor: numbers and names of a PDU in one line, without header and padding.
class BriefFields {
 public:
  BriefFields(std::string& out, const auto& pdu) : out_(out), meanings_(pdu) {}

  template <typename T>
  void operator()(std::string_view name, const T& value) {
    if (name == "header" || name.starts_with("padding")) return;
    if constexpr (std::same_as<T, pdu::EntityId>) {
      if (named_first_) item(name, id_text(value));
      named_first_ = true;  // the first one has its own column
    } else if constexpr (std::same_as<T, pdu::SimulationAddress>) {
      item(name, fmt::format("{}:{}", value.site, value.application));
    } else if constexpr (std::same_as<T, pdu::MunitionDescriptor>) {
      type("munition", value.munition_type);
    } else if constexpr (std::same_as<T, pdu::ExpendableDescriptor>) {
      type("expendable", value.expendable_type);
    } else if constexpr (std::same_as<T, pdu::ExplosionDescriptor>) {
      type("explosion of", value.exploding_object_type);
      item("explosive_force", fmt::format("{} kg", value.explosive_force));
    } else if constexpr (std::same_as<T, pdu::WorldCoordinates>) {
      const auto place = pdu::geodetic_from(value);
      std::string text;
      if (place.has_value()) append_place(text, *place);
      if (place.has_value()) item(name, text);
    } else if constexpr (pdu::Scalar<T>) {
      std::string text;
      pdu::TextSink sink(text);
      if constexpr (std::is_integral_v<T>)
        sink.number(value);
      else
        pdu::put_json_number(sink, value);
      if constexpr (pdu::kMayHaveNames<T>) {
        const std::string_view named = pdu::name_in(meanings_.of(name), value);
        if (!named.empty()) text = named;
      }
      if (meanings_.has_readings()) append_reading(text, name);
      item(name, text);
    }
  }
  template <typename Span, typename Record, typename Count>
  void count(std::string_view name, const Span& view, pdu::Records<Record, Count>) {
    item(name, fmt::format("{}", view.size() / pdu::kFixedSize<Record>));
  }
  template <typename... Any>
  void records(Any&&...) {}
  void walked(std::string_view, const pdu::VariableDatums& datums) {
    for (const pdu::VariableDatum& datum : datums.records()) {
      const std::string_view text = pdu::text_in(datum.value);
      if (text.empty()) continue;
      std::string quoted;
      pdu::TextSink sink(quoted);
      pdu::put_json_string(sink, text);
      item("text", quoted);
    }
  }
  void walked(std::string_view, const auto&) {}

 private:
  /// " (mode_3a 4721, state on)".
  void append_reading(std::string& text, std::string_view name) const {
    pdu::FieldReadings readings;
    meanings_.read(name, readings);
    std::string_view before = " (";
    for (const pdu::FieldReading& part : readings.parts()) {
      text.append(before).append(part.key).append(" ").append(part.view());
      if (!part.unit.empty()) text.append(" ").append(part.unit);
      before = ", ";
    }
    if (!readings.parts().empty()) text += ')';
  }
  void type(std::string_view name, const pdu::EntityType& value) {
    std::string words;
    pdu::TextSink sink(words);
    pdu::put_type_in_words(sink, value);
    item(name, words);
  }
  void item(std::string_view name, std::string_view text) {
    fmt::format_to(end_of(out_), FMT_COMPILE("{}{} {}"), first_ ? "" : ", ", name, text);
    first_ = false;
  }

  std::string& out_;
  pdu::FieldMeanings meanings_;
  bool first_ = true;
  bool named_first_ = false;
};

/// What peers say about the owners of bodies.
void append_agreement(std::string& out, const PduRow& row) {
  if (!may_be_about_owners(row.header.pdu_type)) return;
  const std::string text = ownership_text(row.bytes);
  if (!text.empty()) out.append("; ").append(text);
}

void append_brief(std::string& out, const PduRow& row) {
  if (row.entity_state != nullptr) return append_entity_state(out, *row.entity_state);
  (void)pdu::visit(row.bytes, row.header, [&]<typename Pdu>(const Pdu& pdu) {
    if constexpr (std::same_as<Pdu, pdu::Attribute>) {
      append_attribute(out, pdu);
    } else {
      BriefFields brief(out, pdu);
      fields(brief, pdu);
      append_agreement(out, row);
    }
  });
}

/// A number aligned right in a column of `width`. A wider number widens its line.
void append_right(std::string& out, std::uint64_t value, std::size_t width) {
  const fmt::format_int text(value);
  out.append(width - std::min(text.size(), width), ' ');
  out.append(text.data(), text.size());
}

/// ASCII text aligned left in a column of `width`.
void append_left(std::string& out, std::string_view text, std::size_t width) {
  out += text;
  out.append(width - std::min(text.size(), width), ' ');
}

void append_indented(std::string& out, std::string_view lines, std::size_t depth) {
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    out.append(2 * depth, ' ');
    out += lines.substr(0, end);
    out += '\n';
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
}

/// Its name, or its number if it has none.
std::string form_text(pdu::CompressedForm form) {
  const std::string_view name = pdu::name(form);
  return name.empty() ? fmt::format("form {}", static_cast<unsigned>(form)) : std::string(name);
}

/// A line for each state of Compressed States, after the PDU's line.
void append_states(std::string& out, const std::vector<RestoredState>& states) {
  for (const RestoredState& state : states) {
    fmt::format_to(end_of(out), FMT_COMPILE("{:>17} {:>12}    {:<22} {:>6}  {:<16} "),
                   state.row.offset, "", fmt::format("{} state", form_text(state.form)),
                   state.octets, id_text(*state.row.id));
    if (state.row.entity_state != nullptr)
      append_entity_state(out, *state.row.entity_state);
    else
      out += state.row.reason;
    if (state.row.has_header) append_timestamp(out, state.row.header);
    out += '\n';
  }
}

/// The same as trees of fields.
void append_state_trees(std::string& out, const std::vector<RestoredState>& states) {
  for (const RestoredState& state : states) {
    fmt::format_to(end_of(out), FMT_COMPILE("  state {} +{}  {}  {} octets{}{}\n"),
                   id_text(*state.row.id), state.row.offset, form_text(state.form), state.octets,
                   state.row.reason.empty() ? "" : "  ", state.row.reason);
    std::string lines;
    pdu::TextSink sink(lines);
    if (state.row.decoded) (void)pdu::print_pdu_tree(state.row.bytes, sink);
    append_indented(out, lines, 2);
  }
}

}  // namespace

std::string_view colour_of(PduStatus status) {
  constexpr std::array<std::string_view, 4> kColours{"", "\x1b[36m", "\x1b[33m", "\x1b[31m"};
  return kColours[static_cast<std::size_t>(status)];
}

void append_tail_titles(std::string& out) {
  fmt::format_to(end_of(out), "{:>6} {:>3} {:>6} {:>12}  {:<24} {:>6}  {:<16} {}\n", "FRAME", "PDU",
                 "OFFSET", "TIME s", "TYPE", "LENGTH", "ID", "WHAT");
}

void append_tail_line(std::string& out, const PduRow& row, std::chrono::nanoseconds start,
                      bool colour) {
  const double seconds = pdu::to_seconds(row.time - start);
  append_right(out, row.frame, 6);
  out += ' ';
  append_right(out, row.pdu, 3);
  out += ' ';
  append_right(out, row.offset, 6);
  fmt::format_to(end_of(out), FMT_COMPILE(" {:>12.6f}  "), seconds);
  append_left(out, row.type(), 24);
  out += ' ';
  append_right(out, row.header.length, 6);
  out += "  ";
  append_left(out, row.id.has_value() ? id_text(*row.id) : "-", 16);
  out += ' ';
  if (row.status != PduStatus::ok) append_fault(out, row, colour);
  if (row.status != PduStatus::ok && row.decoded) out += "; ";
  if (row.decoded) append_brief(out, row);
  if (row.has_header) append_timestamp(out, row.header);
  out += '\n';
  if (row.restored != nullptr) append_states(out, *row.restored);
}

void append_tree(std::string& out, const PduRow& row, bool colour) {
  fmt::format_to(end_of(out), "frame {} PDU {} +{}  {}  {} octets", row.frame, row.pdu, row.offset,
                 row.type(), row.bytes.size());
  if (row.status != PduStatus::ok) {
    out += "  ";
    append_fault(out, row, colour);
  }
  out += '\n';
  std::string lines;
  pdu::TextSink sink(lines);
  if (row.has_header) {
    (void)pdu::print_pdu_tree(row.bytes, sink);
  } else {
    sink.text("octets ");
    pdu::put_hex(sink, row.bytes);
  }
  append_indented(out, lines, 1);
  if (row.restored != nullptr) append_state_trees(out, *row.restored);
}

}  // namespace reckon::tools
