// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <string_view>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/inspect/diff/diff_format.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::tools {
namespace {

// JSON
// ------------------------------------------------------------------------------------------------

void json_capture(std::string_view name, const std::string& path, const CaptureSurvey& survey,
                  const std::string& problem, std::string& out) {
  fmt::format_to(end_of(out), "{{\"kind\":\"capture\",\"name\":\"{}\"", name);
  append_json_member(out, "file", path);
  fmt::format_to(end_of(out),
                 ",\"pdus\":{},\"datagrams\":{},\"octets\":{},\"first\":", survey.all.pdus,
                 survey.datagrams, survey.all.octets);
  append_time(out, survey.first);
  fmt::format_to(end_of(out), ",\"seconds\":{}", json_number(survey.seconds(), 12));
  append_json_member(out, "problem", problem);
  out += "}\n";
}

void json_place(std::string_view key, const PduPlace& place, std::string& out) {
  fmt::format_to(end_of(out), ",\"{}\":{{\"frame\":{},\"pdu\":{},\"offset\":{},\"time\":", key,
                 place.frame, place.pdu, place.offset);
  append_time(out, place.time);
  out += '}';
}

void json_who(const PduPlace& place, std::string& out) {
  fmt::format_to(end_of(out), ",\"type\":\"{}\"", place.type);
  if (place.id.has_value()) append_json_member(out, "id", id_text(*place.id));
}

void json_pair(std::string_view kind, const PduPair& pair, std::string& out) {
  fmt::format_to(end_of(out), "{{\"kind\":\"{}\"", kind);
  json_who(pair.a, out);
  json_place("a", pair.a, out);
  json_place("b", pair.b, out);
  if (!pair.fields.empty()) out += ",\"fields\":[";
  for (std::size_t i = 0; i < pair.fields.size(); ++i) {
    const FieldDifference& field = pair.fields[i];
    fmt::format_to(end_of(out), "{}{{\"at\":{}", i == 0 ? "" : ",", field.offset);
    append_json_member(out, "field", field.field);
    append_json_member(out, "a", field.a);
    append_json_member(out, "b", field.b);
    out += '}';
  }
  out += pair.fields.empty() ? "}\n" : "]}\n";
}

void json_differences(const CaptureDifference& found, std::string& out) {
  if (found.first_changed().has_value()) json_pair("first_changed", *found.first_changed(), out);
  if (found.first_moved().has_value()) json_pair("first_moved", *found.first_moved(), out);
  for (const auto& [name, field] : found.fields()) {
    fmt::format_to(end_of(out), "{{\"kind\":\"field\",\"pdus\":{}", field.pdus);
    append_json_member(out, "field", name);
    append_json_member(out, "a", field.first.a);
    append_json_member(out, "b", field.first.b);
    fmt::format_to(end_of(out), ",\"a_frame\":{},\"a_pdu\":{},\"b_frame\":{},\"b_pdu\":{}}}\n",
                   field.a.frame, field.a.pdu, field.b.frame, field.b.pdu);
  }
  const auto alone = [&](std::string_view name, const std::vector<PduPlace>& places) {
    for (const PduPlace& place : places) {
      fmt::format_to(end_of(out), "{{\"kind\":\"only\",\"in\":\"{}\"", name);
      json_who(place, out);
      fmt::format_to(end_of(out), ",\"frame\":{},\"pdu\":{},\"time\":", place.frame, place.pdu);
      append_time(out, place.time);
      out += "}\n";
    }
  };
  alone("a", found.only_a());
  alone("b", found.only_b());
}

void json_types(const CaptureDifference& found, std::string& out) {
  for (const auto& [type, both] : types_of(found)) {
    const auto rate = [](std::uint64_t pdus, double seconds) {
      return seconds > 0 ? json_number(static_cast<double>(pdus) / seconds) : std::string("null");
    };
    fmt::format_to(end_of(out),
                   "{{\"kind\":\"type\",\"key\":\"{}\",\"a_pdus\":{},\"b_pdus\":{},"
                   "\"a_octets\":{},\"b_octets\":{},\"a_pdus_per_s\":{},\"b_pdus_per_s\":{}}}\n",
                   type, both.a.pdus, both.b.pdus, both.a.octets, both.b.octets,
                   rate(both.a.pdus, found.a().seconds()), rate(both.b.pdus, found.b().seconds()));
  }
}

void json_traits(std::string_view side, const EntityTraits* traits, std::string& out) {
  fmt::format_to(end_of(out), ",\"{}_pdus\":{},\"{}_octets\":{}", side,
                 traits == nullptr ? 0 : traits->share.pdus, side,
                 traits == nullptr ? 0 : traits->share.octets);
  if (traits == nullptr || !traits->has_state) return;
  append_json_member(out, fmt::format("{}_marking", side), traits->marking);
  fmt::format_to(end_of(out), ",\"{}_force_id\":{},\"{}_drm\":[", side, traits->force, side);
  bool first = true;
  for (const unsigned number : algorithms_of(*traits)) {
    fmt::format_to(end_of(out), "{}{}", first ? "" : ",", number);
    first = false;
  }
  out += ']';
}

void json_entities(const CaptureDifference& found, std::string& out) {
  for (const EntityInBoth& entity : entities_of(found)) {
    fmt::format_to(end_of(out), "{{\"kind\":\"entity\",\"id\":\"{}\",\"differs\":{}",
                   key_text(entity.key), entity.differs());
    json_traits("a", entity.a, out);
    json_traits("b", entity.b, out);
    out += "}\n";
  }
}

void json_motion(const MotionDifference& motion, std::string& out) {
  for (const auto& [key, pose] : motion.poses()) {
    const peer::Spread metres = pose.metres.histogram.spread();
    const peer::Spread degrees = pose.degrees.histogram.spread();
    fmt::format_to(end_of(out),
                   "{{\"kind\":\"pose\",\"id\":\"{}\",\"instants\":{},\"p50_m\":{},\"p99_m\":{},"
                   "\"max_m\":{},\"max_m_at\":{},\"p50_deg\":{},\"p99_deg\":{},\"max_deg\":{},"
                   "\"max_deg_at\":{}}}\n",
                   key_text(key), metres.count, json_number(metres.p50), json_number(metres.p99),
                   json_number(pose.metres.max), json_number(pdu::to_seconds(pose.metres.max_at)),
                   json_number(degrees.p50), json_number(degrees.p99),
                   json_number(pose.degrees.max),
                   json_number(pdu::to_seconds(pose.degrees.max_at)));
  }
  for (const auto& [key, force] : motion.forces()) {
    const peer::Spread newtons = force.histogram.spread();
    fmt::format_to(end_of(out),
                   "{{\"kind\":\"contact_force\",\"on\":\"{}\",\"by\":\"{}\",\"instants\":{},"
                   "\"p50\":{},\"p99\":{},\"max\":{},\"max_at\":{}}}\n",
                   id_text({key[0], key[1], key[2]}), id_text({key[3], key[4], key[5]}),
                   newtons.count, json_number(newtons.p50), json_number(newtons.p99),
                   json_number(force.max), json_number(pdu::to_seconds(force.max_at)));
  }
}

void json_all(const DiffFindings& findings, std::string& out) {
  const CaptureDifference& found = findings.difference;
  const peer::Spread times = found.times().spread();
  fmt::format_to(end_of(out),
                 "{{\"kind\":\"all\",\"summary\":\"diff\",\"same\":{},\"pdus_same\":{},"
                 "\"pdus_changed\":{},\"pdus_moved\":{},\"only_a\":{},\"only_b\":{},\"shift\":",
                 findings.is_same(), found.same(), found.changed(), found.moved(),
                 found.count_only_a(), found.count_only_b());
  if (found.shift().has_value())
    append_time(out, *found.shift());
  else
    out += "null";
  fmt::format_to(end_of(out), ",\"rate\":{},\"time_p50\":{},\"time_p99\":{},\"time_max\":{}}}\n",
                 json_number(found.rate()), json_number(times.p50), json_number(times.p99),
                 json_number(found.greatest_time()));
}

// CSV
// ------------------------------------------------------------------------------------------------

/// One row: a and b as text, the difference if it is a number.
void csv_row(std::string_view what, std::string_view key, std::string_view a, std::string_view b,
             std::string_view difference, std::string& out) {
  out += what;
  for (const std::string_view cell : {key, a, b, difference}) {
    out += ',';
    append_csv_cell(out, cell);
  }
  out += '\n';
}

void csv_count(std::string_view what, std::string_view key, std::uint64_t a, std::uint64_t b,
               std::string& out) {
  csv_row(what, key, fmt::format("{}", a), fmt::format("{}", b),
          fmt::format("{}", static_cast<std::int64_t>(b) - static_cast<std::int64_t>(a)), out);
}

void csv_number(std::string_view what, std::string_view key, double value, std::string& out) {
  csv_row(what, key, "", "", fmt::format("{:.6g}", value), out);
}

void csv_places(std::string_view what, bool in_a, const std::vector<PduPlace>& places,
                std::string& out) {
  for (const PduPlace& place : places) {
    const std::string at = fmt::format("{}.{}", place.frame, place.pdu);
    const std::string key = place.id.has_value()
                                ? fmt::format("{} {}", place.type, id_text(*place.id))
                                : std::string(place.type);
    csv_row(what, key, in_a ? at : "", in_a ? "" : at, "", out);
  }
}

}  // namespace

void append_diff_json(const DiffFindings& findings, std::string& out) {
  const CaptureDifference& found = findings.difference;
  json_capture("a", findings.path_a, found.a(), findings.problem_a, out);
  json_capture("b", findings.path_b, found.b(), findings.problem_b, out);
  json_differences(found, out);
  json_types(found, out);
  json_entities(found, out);
  json_motion(findings.motion, out);
  json_all(findings, out);
}

void append_diff_csv(const DiffFindings& findings, std::string& out) {
  const CaptureDifference& found = findings.difference;
  out += "what,key,a,b,difference\n";
  csv_count("pdus", "", found.a().all.pdus, found.b().all.pdus, out);
  csv_count("octets", "", found.a().all.octets, found.b().all.octets, out);
  for (const auto& [type, both] : types_of(found))
    csv_count("type", type, both.a.pdus, both.b.pdus, out);
  for (const EntityInBoth& entity : entities_of(found))
    csv_count("entity", key_text(entity.key), entity.a == nullptr ? 0 : entity.a->share.pdus,
              entity.b == nullptr ? 0 : entity.b->share.pdus, out);
  for (const auto& [name, field] : found.fields())
    csv_row("field", name, field.first.a, field.first.b, fmt::format("{}", field.pdus), out);
  csv_places("only_a", true, found.only_a(), out);
  csv_places("only_b", false, found.only_b(), out);
  for (const auto& [key, pose] : findings.motion.poses()) {
    csv_number("pose_max_m", key_text(key), pose.metres.max, out);
    csv_number("pose_max_deg", key_text(key), pose.degrees.max, out);
  }
  for (const auto& [key, force] : findings.motion.forces())
    csv_number("force_max_n",
               fmt::format("{} by {}", id_text({key[0], key[1], key[2]}),
                           id_text({key[3], key[4], key[5]})),
               force.max, out);
}

void append_diff(const DiffFindings& findings, Format format, std::string& out) {
  if (format == Format::text) append_diff_text(findings, out);
  if (format == Format::json) append_diff_json(findings, out);
  if (format == Format::csv) append_diff_csv(findings, out);
}

}  // namespace reckon::tools
