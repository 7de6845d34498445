// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/filter_fields.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <vector>

#include "reckon/pdu/field_search.hpp"
#include "reckon/pdu/geodetic.hpp"
#include "reckon/pdu/print.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/tools/datagrams/first_location.hpp"
#include "reckon/tools/datagrams/foreign.hpp"

namespace reckon::tools {
namespace {

using Number = std::optional<double>;
using Text = std::optional<std::string>;

template <typename Enumeration>
std::string_view name_of(unsigned value) {
  return pdu::name(static_cast<Enumeration>(value));
}
template <pdu::SisoTable table>
std::string_view listed_name(unsigned value) {
  return pdu::siso_name(table, value);
}
constexpr unsigned kCountries = 1024;  // greater than all named values

std::string type_in_words(const pdu::EntityType& type) {
  std::string words;
  pdu::TextSink sink(words);
  pdu::put_type_in_words(sink, type);
  return words;
}

std::string_view type_name(unsigned value) {
  const auto type = static_cast<pdu::PduType>(value);
  return pdu::is_named(type) ? pdu::snake_name(type) : "";
}
std::string_view status_name(unsigned value) {
  return value < 4 ? name(static_cast<PduStatus>(value)) : "";
}

/// The rules that can occur in a row.
constexpr std::array kOtherRules{kForeignRule,     kNoLengthRule,  kTrailingRule,
                                 kTrailingWarning, kByteOrderRule, std::string_view("E-FRAGMENT")};
constexpr unsigned kRules = static_cast<unsigned>(pdu::DecodeError::not_finite) + 1;
std::string_view row_rule(unsigned value) {
  if (value < kRules) return pdu::rule(static_cast<pdu::DecodeError>(value));
  return value - kRules < kOtherRules.size() ? kOtherRules[value - kRules] : "";
}

/// Getters of numbers: from any PDU with a header, and from Entity States.
template <auto Get>
Number from_header(const FilterSubject& subject) {
  if (!subject.row.has_header) return std::nullopt;
  return static_cast<double>(Get(subject.row.header));
}
template <auto Get>
Number from_state(const FilterSubject& subject) {
  if (subject.entity_state == nullptr) return std::nullopt;
  return static_cast<double>(Get(*subject.entity_state));
}

double speed(const pdu::EntityState& pdu) {
  const pdu::Vector3Float& v = pdu.linear_velocity;
  return std::hypot(double{v.x}, double{v.y}, double{v.z});
}
Text endpoint(const peer::IpEndpoint& endpoint) {
  if (endpoint.is_unspecified()) return std::nullopt;
  return endpoint.text();
}

/// A coordinate of the PDU's location, in W or on WGS84.
template <auto Member>
Number from_location(const FilterSubject& subject) {
  const auto location = first_location(subject.entity);
  if (!location.has_value()) return std::nullopt;
  return *location.*Member;
}
template <auto Member>
Number from_place(const FilterSubject& subject) {
  const auto location = first_location(subject.entity);
  const auto place = location.has_value() ? pdu::geodetic_from(*location) : std::nullopt;
  if (!place.has_value()) return std::nullopt;
  return *place.*Member;
}
template <auto Member>
Number from_attitude(const FilterSubject& subject) {
  if (subject.entity_state == nullptr) return std::nullopt;
  const auto place = pdu::geodetic_from(subject.entity_state->location);
  if (!place.has_value()) return std::nullopt;
  const auto attitude = pdu::attitude_from(subject.entity_state->orientation, *place);
  if (!attitude.has_value()) return std::nullopt;
  return *attitude.*Member;
}
Number port_of(const peer::IpEndpoint& endpoint) {
  if (endpoint.is_unspecified()) return std::nullopt;
  return endpoint.port;
}

using Header = pdu::PduHeader;
using State = pdu::EntityState;

/// THE list of fields.
constexpr auto kFields = std::to_array<FilterField>({
    {"entity.id", "site:application:entity, each a number or *", ValueKind::id},
    {"entity.side", "its force ID: friendly, opposing, neutral, or a number", ValueKind::name,
     from_state<[](const State& s) { return s.force_id; }>, name_of<pdu::ForceId>},
    {"entity.kind", "kind of its type: platform, munition, life_form, ..., or a number",
     ValueKind::name, from_state<[](const State& s) { return s.entity_type.kind; }>,
     name_of<pdu::EntityKind>},
    {"entity.domain", "domain of its type: land, air, surface, subsurface, space, or a number",
     ValueKind::name, from_state<[](const State& s) { return s.entity_type.domain; }>,
     name_of<pdu::EntityDomain>},
    {"entity.country", "country of its type: usa, germany, \"United States\", ..., or a number",
     ValueKind::name, from_state<[](const State& s) { return s.entity_type.country; }>,
     listed_name<pdu::SisoTable::country>, nullptr, listed_name<pdu::SisoTable::country_code>,
     kCountries},
    {"entity.category", "category of its type, a number", ValueKind::number,
     from_state<[](const State& s) { return s.entity_type.category; }>},
    {"entity.words",
     "its type in words, for example Platform Land Germany Tank; * stands for any letters",
     ValueKind::text, nullptr, nullptr,
     [](const FilterSubject& s) -> Text {
       if (s.entity_state == nullptr) return std::nullopt;
       return type_in_words(s.entity_state->entity_type);
     }},
    {"entity.type",
     "its type as numbers; * matches any, and trailing numbers may be omitted: 1.1.225.*",
     ValueKind::type},
    {"entity.drm", "its dead reckoning: static, fpw, rvw, ..., or a number", ValueKind::name,
     from_state<[](const State& s) { return s.dead_reckoning.algorithm; }>,
     name_of<pdu::DeadReckoningAlgorithm>},
    {"entity.speed", "magnitude of its velocity in m/s", ValueKind::number, from_state<speed>},
    {"entity.marking", "its marking; * stands for any letters", ValueKind::text, nullptr, nullptr,
     [](const FilterSubject& s) -> Text {
       if (s.entity_state == nullptr) return std::nullopt;
       return std::string(s.entity_state->marking.view());
     }},
    {"entity.heading", "direction of its x axis, degrees clockwise from north", ValueKind::number,
     from_attitude<&pdu::Attitude::heading_deg>},
    {"entity.pitch", "elevation of its x axis in degrees", ValueKind::number,
     from_attitude<&pdu::Attitude::pitch_deg>},
    {"entity.roll", "rotation about its x axis in degrees, right side down", ValueKind::number,
     from_attitude<&pdu::Attitude::roll_deg>},
    {"latitude", "latitude of the PDU's first position in degrees north (WGS84)", ValueKind::number,
     from_place<&pdu::Geodetic::latitude_deg>},
    {"longitude", "longitude of the same in degrees east", ValueKind::number,
     from_place<&pdu::Geodetic::longitude_deg>},
    {"height", "height of the same in metres above the ellipsoid", ValueKind::number,
     from_place<&pdu::Geodetic::height>},
    {"location.x", "geocentric x of the same in metres", ValueKind::number,
     from_location<&pdu::WorldCoordinates::x>},
    {"location.y", "of the same", ValueKind::number, from_location<&pdu::WorldCoordinates::y>},
    {"location.z", "of the same", ValueKind::number, from_location<&pdu::WorldCoordinates::z>},
    {"type", "PDU type: entity_state, attribute, ..., or a number", ValueKind::name,
     from_header<[](const Header& h) { return h.pdu_type; }>, type_name},
    {"exercise", "exercise ID", ValueKind::number,
     from_header<[](const Header& h) { return h.exercise_id; }>},
    {"version", "protocol version: 7 is DIS 7", ValueKind::number,
     from_header<[](const Header& h) { return h.protocol_version; }>},
    {"length", "length field of the header, in octets", ValueKind::number,
     from_header<[](const Header& h) { return h.length; }>},
    {"time", "arrival in seconds since the first datagram of the source", ValueKind::number,
     [](const FilterSubject& s) -> Number { return pdu::to_seconds(s.row.time - s.row.start); }},
    {"frame", "number of the datagram's frame", ValueKind::number,
     [](const FilterSubject& s) -> Number { return static_cast<double>(s.row.frame); }},
    {"pdu", "place in the datagram, from 1", ValueKind::number,
     [](const FilterSubject& s) -> Number { return static_cast<double>(s.row.pdu); }},
    {"status", "ok, note, warning or error", ValueKind::name,
     [](const FilterSubject& s) -> Number { return static_cast<double>(s.row.status); },
     status_name},
    {"rule", "the violated rule: E-LENGTH, E-*, ...", ValueKind::text, nullptr, row_rule,
     [](const FilterSubject& s) -> Text {
       if (s.row.rule.empty()) return std::nullopt;
       return std::string(s.row.rule);
     }},
    {"sender", "address:port that sent it; * stands for any letters", ValueKind::text, nullptr,
     nullptr, [](const FilterSubject& s) { return endpoint(s.datagram.source); }},
    {"group", "address:port that it was sent to; * stands for any letters", ValueKind::text,
     nullptr, nullptr, [](const FilterSubject& s) { return endpoint(s.datagram.group); }},
    {"port", "UDP port that it was sent to", ValueKind::number,
     [](const FilterSubject& s) { return port_of(s.datagram.group); }},
    {"sender_port", "UDP port that it was sent from", ValueKind::number,
     [](const FilterSubject& s) { return port_of(s.datagram.source); }},
});

}  // namespace

std::span<const FilterField> filter_fields() { return kFields; }

std::string filter_fields_text() {
  std::string text;
  for (const FilterField& field : kFields)
    fmt::format_to(std::back_inserter(text), "  {:<16} {}\n", field.name, field.meaning);
  return text +
         "A field of a PDU type has its name in --full, or the end of that name, such "
         "as\nfrequency, munition_type.kind or beams[0].beam_function; --fields TYPE lists them.";
}

std::string types_with_fields() {
  std::string words;
  for (unsigned number = 0; number < 256; ++number) {
    const auto type = static_cast<pdu::PduType>(number);
    if (pdu::is_listed(type)) words.append(pdu::snake_name(type)).append(" ");
  }
  return words;
}

std::string table_fields_text(std::string_view type) {
  std::vector<std::string_view> types;
  for (unsigned number = 0; number < 256; ++number) {
    const auto known = static_cast<pdu::PduType>(number);
    if (!pdu::is_listed(known)) continue;
    types.push_back(pdu::snake_name(known));
    if (types.back() != type) continue;
    std::string text;
    std::set<std::string, std::less<>> shown;
    pdu::each_field_path(known, [&](std::string_view path) {
      if (shown.emplace(path).second) text.append(path).append("\n");
    });
    return text;
  }
  const std::string_view nearest = peer::nearest_word(type, types);
  throw UsageError(fmt::format("--fields {}: no PDU type{}", type,
                               nearest.empty()
                                   ? " with a field table, for example entity_state or transmitter"
                                   : fmt::format("; did you mean '{}'?", nearest)));
}

}  // namespace reckon::tools
