// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/emissions/emission_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <variant>

#include "reckon/pdu/field_names.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

// "9.4 GHz".  @param digits significant ones: a float has 6
std::string hertz_text(double hertz, int digits) {
  if (hertz >= 1e9) return fmt::format("{:.{}g} GHz", hertz / 1e9, digits);
  if (hertz >= 1e6) return fmt::format("{:.{}g} MHz", hertz / 1e6, digits);
  return fmt::format("{:.{}g} kHz", hertz / 1e3, digits);
}

std::string entity_text(const pdu::EntityId& id) {
  return fmt::format("{}:{}:{}", id.site, id.application, id.entity);
}

// The name of a field's value, or its number.
std::string value_text(const auto& record, std::string_view field, std::uint16_t value) {
  const std::string_view name = pdu::name_in(pdu::meaning_in(record, field), value);
  return name.empty() ? fmt::format("{} {}", field, value) : std::string(name);
}

// The codes of the enabled modes.
std::string codes_text(const pdu::Iff& iff) {
  std::string text;
  for (const std::string_view field :
       {"parameter_1", "parameter_2", "parameter_3", "parameter_4", "parameter_5"}) {
    pdu::FieldReadings readings;
    pdu::read_field(iff, field, readings);
    const auto parts = readings.parts();
    if (parts.size() == 2 && parts[1].view() == "on")
      text += fmt::format(", {} {}{}", parts[0].key, parts[0].view(), parts[0].unit);
  }
  return text;
}

std::string beam_text(const peer::EmittedBeam& beam) {
  std::string text = fmt::format(
      "{}, {}, {:g} dBm", value_text(beam.beam, "beam_function", beam.beam.beam_function),
      hertz_text(double{beam.beam.frequency}, 6), double{beam.beam.effective_radiated_power});
  if (beam.beam.high_density_track_jam == 1) text += ", high density track/jam";
  std::string_view lead = ", targets";
  for (const pdu::TrackJamTarget& target : beam.known_targets()) {
    text += fmt::format("{} {}", lead, entity_text(target.entity_id));
    lead = "";
  }
  return text;
}

std::string state_text(const peer::Emission& emission) {
  if (const auto* emitter = std::get_if<peer::EmitterState>(&emission.state))
    return emitter->count > 0 ? counted(emitter->count, "beam") : "no beam";
  if (const auto* radio = std::get_if<pdu::Transmitter>(&emission.state))
    return value_text(*radio, "transmit_state", radio->transmit_state);
  return emission.emits() ? "on" : "off";
}

std::string what_text(const peer::Emission& emission) {
  if (const auto* emitter = std::get_if<peer::EmitterState>(&emission.state))
    return fmt::format("{}, {}", value_text(emitter->system, "emitter_name", emitter->system.name),
                       value_text(emitter->system, "emitter_function", emitter->system.function));
  if (const auto* iff = std::get_if<pdu::Iff>(&emission.state))
    return value_text(*iff, "system_type", iff->system_type) + codes_text(*iff);
  const auto& radio = *std::get_if<pdu::Transmitter>(&emission.state);
  const pdu::ModulationType& modulation = radio.modulation_type;
  return fmt::format("{}, {}", hertz_text(static_cast<double>(radio.frequency), 9),
                     value_text(modulation, "major_modulation", modulation.major_modulation));
}

void append_beam_json(std::string& out, const peer::EmittedBeam& beam, nanoseconds origin) {
  JsonObject object(out);
  object.value("active", beam.is_active());
  object.decimals("since", pdu::to_seconds(beam.since - origin), 3);
  pdu::TextSink sink(object.member("fields"));
  print_named_json(beam.beam, sink);
  object.array("track_jam_targets", beam.known_targets(),
               [](std::string& text, const pdu::TrackJamTarget& target) {
                 pdu::TextSink inner(text);
                 print_json(target, inner);
               });
  object.end();
}

}  // namespace

std::string emissions_table(std::span<const peer::Emission* const> rows, nanoseconds origin,
                            nanoseconds now) {
  constexpr auto kRight = TextTable::Align::right;
  constexpr std::array<std::string_view, 3> kSystems{"emitter", "IFF", "radio"};
  const auto seconds = [&](nanoseconds time) {
    return fmt::format("{:.3f}", pdu::to_seconds(time - origin));
  };
  TextTable table({{"ENTITY"},
                   {"SYSTEM"},
                   {"STATE"},
                   {"SINCE s", kRight},
                   {"LAST s", kRight},
                   {"UPDATES", kRight},
                   {"WHAT"}});
  for (const peer::Emission* row : rows) {
    table.add({entity_text(row->entity),
               fmt::format("{} {}", kSystems[row->state.index()], row->number),
               state_text(*row) + (row->is_over(now) ? ", over" : ""), seconds(row->since),
               seconds(row->last_heard), fmt::format("{}", row->updates), what_text(*row)});
    const auto* emitter = std::get_if<peer::EmitterState>(&row->state);
    if (emitter == nullptr) continue;
    for (const peer::EmittedBeam& beam : emitter->known_beams())
      table.add({"", fmt::format("  beam {}", beam.beam.beam_number),
                 beam.is_active() ? "active" : "off", seconds(beam.since), "", "",
                 beam_text(beam)});
  }
  return table.text();
}

std::string emitted_text(const peer::EmittedView& view) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (view.emitters > 0)
    add(fmt::format("{} of {}", counted(view.beams, "beam"), counted(view.emitters, "emitter")));
  if (view.beams > 0) text += ", " + hertz_text(double{view.beam_hz}, 6);
  if (view.targets > 0) text += ", " + counted(view.targets, "target");
  pdu::Iff iff;
  iff.system_type = view.iff_type;
  iff.parameter_3 = view.mode_3a;
  if (view.iff > 0) add(view.iff_on > 0 ? "IFF on" + codes_text(iff) : "IFF off");
  if (view.transmitting > 0)
    add("transmits at " + hertz_text(view.radio_hz, 9));
  else if (view.radios > 0)
    add(counted(view.radios, "radio") + " silent");
  return text;
}

void append_emission_json(std::string& out, const peer::Emission& emission, nanoseconds origin,
                          nanoseconds now) {
  constexpr std::array<std::string_view, 3> kKinds{"emitter", "iff", "radio"};
  JsonObject object(out);
  object.text("id", entity_text(emission.entity))
      .text("kind", kKinds[emission.state.index()])
      .value("number", emission.number)
      .value("emits", emission.emits())
      .value("over", emission.is_over(now))
      .decimals("since", pdu::to_seconds(emission.since - origin), 3)
      .decimals("last", pdu::to_seconds(emission.last_heard - origin), 3)
      .value("updates", emission.updates);
  pdu::TextSink sink(object.member("fields"));
  if (const auto* iff = std::get_if<pdu::Iff>(&emission.state)) print_named_json(*iff, sink);
  if (const auto* radio = std::get_if<pdu::Transmitter>(&emission.state))
    print_named_json(*radio, sink);
  if (const auto* emitter = std::get_if<peer::EmitterState>(&emission.state)) {
    print_named_json(emitter->system, sink);
    object.array("beams", emitter->known_beams(),
                 [&](std::string& text, const peer::EmittedBeam& beam) {
                   append_beam_json(text, beam, origin);
                 });
    object.value("beams_left_out", emitter->left_out);
  }
  object.end();
}

}  // namespace reckon::tools
