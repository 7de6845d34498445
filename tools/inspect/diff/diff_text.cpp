// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/inspect/diff/diff_format.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr auto kNumbers = TextTable::Align::right;
/// Greatest number of rows in a table; --json and --csv have more.
constexpr std::size_t kMostRows = 20;
constexpr std::size_t kMostAlone = 5;

/// A time with a suitable unit.
std::string time_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} us", 1e6 * seconds);
  return seconds < 1 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.6g} s", seconds);
}

std::string place_text(const PduPlace& place) {
  return fmt::format("frame {} PDU {}", place.frame, place.pdu);
}

std::string who(const PduPlace& place) {
  return fmt::format("{}{}{}", place.type, place.id.has_value() ? " " : "",
                     place.id.has_value() ? id_text(*place.id) : std::string());
}

std::string printable(std::string_view text) {
  std::string out;
  for (const char letter : text) out += letter < 0x20 || letter > 0x7E ? '?' : letter;
  return out;
}

void append_and_more(std::string& out, std::size_t all, std::size_t shown) {
  if (all > shown) fmt::format_to(end_of(out), "and {} more: --json has them\n", all - shown);
}

void append_captures(const DiffFindings& findings, std::string& out) {
  TextTable table({{""},
                   {"CAPTURE"},
                   {"PDUs", kNumbers},
                   {"DATAGRAMS", kNumbers},
                   {"OCTETS", kNumbers},
                   {"s", kNumbers},
                   {"PDU/s", kNumbers}});
  const auto add = [&](std::string_view name, const std::string& path,
                       const CaptureSurvey& survey) {
    const double seconds = survey.seconds();
    table.add({std::string(name), path, fmt::format("{}", survey.all.pdus),
               fmt::format("{}", survey.datagrams), fmt::format("{}", survey.all.octets),
               fmt::format("{:.3f}", seconds),
               seconds > 0 ? fmt::format("{:.1f}", static_cast<double>(survey.all.pdus) / seconds)
                           : "-"});
  };
  add("A", findings.path_a, findings.difference.a());
  add("B", findings.path_b, findings.difference.b());
  out += table.text();
}

void append_verdict(const DiffFindings& findings, std::string& out) {
  const CaptureDifference& found = findings.difference;
  const std::uint64_t different =
      found.changed() + found.moved() + found.count_only_a() + found.count_only_b();
  if (different == 0)
    fmt::format_to(end_of(out), "\n{} in both, in the same order\n", counted(found.same(), "PDU"));
  else
    fmt::format_to(end_of(out), "\n{} in both, {} changed, {} only in A, {} only in B, {} moved\n",
                   counted(found.same(), "PDU"), found.changed(), found.count_only_a(),
                   found.count_only_b(), found.moved());
  if (!found.shift().has_value()) return;
  const peer::Spread times = found.times().spread();
  fmt::format_to(end_of(out), "B is {:+.9f} s against A", pdu::to_seconds(*found.shift()));
  if (found.rate() != 1)
    fmt::format_to(end_of(out), " and was played {:.4g} times as fast: its times are scaled to A's",
                   found.rate());
  out += "; without that, arrivals are ";
  if (found.greatest_time() == 0)
    out += "the same\n";
  else
    fmt::format_to(end_of(out), "apart by p50 {}, p99 {}, max {}\n", time_text(times.p50),
                   time_text(times.p99), time_text(found.greatest_time()));
  if (findings.tolerance.has_value())
    fmt::format_to(
        end_of(out), "that is {} the {} of --within\n",
        found.greatest_time() <= pdu::to_seconds(*findings.tolerance) ? "within" : "more than",
        time_text(pdu::to_seconds(*findings.tolerance)));
}

void append_changed(const PduPair& pair, std::string& out) {
  fmt::format_to(end_of(out), "A {}, B {}: {}\n", place_text(pair.a), place_text(pair.b),
                 who(pair.a));
  for (const FieldDifference& field : pair.fields)
    fmt::format_to(end_of(out), "  octet {} (datagram +{}): {} is {} in A, {} in B\n", field.offset,
                   pair.a.offset + field.offset, field.field, field.a, field.b);
}

void append_alone(std::string_view name, const std::vector<PduPlace>& places, std::string& out) {
  if (places.empty()) return;
  fmt::format_to(end_of(out), "\nONLY IN {}\n", name);
  for (std::size_t i = 0; i < std::min(places.size(), kMostAlone); ++i)
    fmt::format_to(end_of(out), "  {}: {}\n", place_text(places[i]), who(places[i]));
  append_and_more(out, places.size(), kMostAlone);
}

void append_differences(const CaptureDifference& found, std::string& out) {
  if (found.first_changed().has_value()) {
    out += "\nFIRST CHANGED PDU\n";
    append_changed(*found.first_changed(), out);
  }
  if (found.changed() > 1) {
    TextTable table(
        {{"CHANGED FIELD"}, {"PDUs", kNumbers}, {"FIRST IN A"}, {"IN B"}, {"A"}, {"B"}});
    std::size_t rows = 0;
    for (const auto& [name, field] : found.fields()) {
      if (++rows > kMostRows) break;
      table.add({name, fmt::format("{}", field.pdus), place_text(field.a), place_text(field.b),
                 field.first.a, field.first.b});
    }
    out += '\n';
    out += table.text();
    append_and_more(out, found.fields().size(), kMostRows);
  }
  append_alone("A", found.only_a(), out);
  append_alone("B", found.only_b(), out);
  if (!found.first_moved().has_value()) return;
  const PduPair& moved = *found.first_moved();
  fmt::format_to(end_of(out), "\nFIRST MOVED PDU\n  A {}, B {}: {}\n", place_text(moved.a),
                 place_text(moved.b), who(moved.a));
}

void append_types(const CaptureDifference& found, std::string& out) {
  TextTable table({{"BY TYPE"},
                   {"PDUs A", kNumbers},
                   {"B", kNumbers},
                   {"OCTETS A", kNumbers},
                   {"B", kNumbers},
                   {"PDU/s A", kNumbers},
                   {"B", kNumbers}});
  const auto rate = [](std::uint64_t count, double seconds) {
    return seconds > 0 ? fmt::format("{:.1f}", static_cast<double>(count) / seconds)
                       : std::string("-");
  };
  for (const auto& [type, both] : types_of(found)) {
    if (both.a.pdus == both.b.pdus && both.a.octets == both.b.octets) continue;
    table.add({std::string(type), fmt::format("{}", both.a.pdus), fmt::format("{}", both.b.pdus),
               fmt::format("{}", both.a.octets), fmt::format("{}", both.b.octets),
               rate(both.a.pdus, found.a().seconds()), rate(both.b.pdus, found.b().seconds())});
  }
  if (table.empty()) return;
  out += '\n';
  out += table.text();
}

std::string algorithms_text(const EntityTraits& traits) {
  std::string out;
  for (const unsigned number : algorithms_of(traits)) {
    const std::string_view name = pdu::name(static_cast<pdu::DeadReckoningAlgorithm>(number));
    if (!out.empty()) out += ", ";
    out += name.empty() ? fmt::format("{}", number) : std::string(name);
  }
  return out.empty() ? "-" : out;
}

/// One value if both are equal, else both.
std::string both_text(const EntityInBoth& entity, std::string (*text)(const EntityTraits&)) {
  if (entity.a == nullptr || entity.b == nullptr)
    return text(entity.a != nullptr ? *entity.a : *entity.b);
  const std::string a = text(*entity.a);
  const std::string b = text(*entity.b);
  return a == b ? a : fmt::format("{} | {}", a, b);
}

void append_entities(const CaptureDifference& found, std::string& out) {
  TextTable table(
      {{"BY ENTITY"}, {"PDUs A", kNumbers}, {"B", kNumbers}, {"MARKING"}, {"SIDE"}, {"DRM"}});
  std::size_t rows = 0;
  for (const EntityInBoth& entity : entities_of(found)) {
    if (!entity.differs() || ++rows > kMostRows) continue;
    const auto count = [](const EntityTraits* traits) {
      return traits == nullptr ? std::string("-") : fmt::format("{}", traits->share.pdus);
    };
    table.add({key_text(entity.key), count(entity.a), count(entity.b),
               both_text(entity, [](const EntityTraits& t) { return printable(t.marking); }),
               both_text(entity,
                         [](const EntityTraits& t) {
                           return t.has_state ? fmt::format("{}", t.force) : std::string("-");
                         }),
               both_text(entity, algorithms_text)});
  }
  if (table.empty()) return;
  out += '\n';
  out += table.text();
  append_and_more(out, rows, kMostRows);
}

void append_poses(const DiffFindings& findings, std::string& out) {
  const auto& poses = findings.motion.poses();
  if (poses.empty()) return;
  using Row = std::pair<MotionDifference::EntityKey, const PoseDifference*>;
  std::vector<Row> rows;
  for (const auto& [key, pose] : poses)
    if (pose.metres.max > 0 || pose.degrees.max > 0) rows.emplace_back(key, &pose);
  fmt::format_to(
      end_of(out), "\nPoses of {} in both, dead reckoned each {:g} ms: {}\n",
      poses.size() == 1 ? std::string("1 entity") : fmt::format("{} entities", poses.size()),
      1e3 * pdu::to_seconds(findings.step),
      rows.empty() ? "the same" : fmt::format("{} differ", rows.size()));
  if (rows.empty()) return;
  std::ranges::stable_sort(
      rows, [](const Row& a, const Row& b) { return a.second->metres.max > b.second->metres.max; });
  TextTable table({{"POSE OF"},
                   {"p50 m", kNumbers},
                   {"p99 m", kNumbers},
                   {"max m", kNumbers},
                   {"AT s", kNumbers},
                   {"p50 deg", kNumbers},
                   {"p99 deg", kNumbers},
                   {"max deg", kNumbers}});
  for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i) {
    const PoseDifference& pose = *rows[i].second;
    const peer::Spread metres = pose.metres.histogram.spread();
    const peer::Spread degrees = pose.degrees.histogram.spread();
    table.add({key_text(rows[i].first), fmt::format("{:.3g}", metres.p50),
               fmt::format("{:.3g}", metres.p99), fmt::format("{:.4g}", pose.metres.max),
               fmt::format("{:.2f}", pdu::to_seconds(pose.metres.max_at)),
               fmt::format("{:.3g}", degrees.p50), fmt::format("{:.3g}", degrees.p99),
               fmt::format("{:.4g}", pose.degrees.max)});
  }
  out += table.text();
  append_and_more(out, rows.size(), kMostRows);
}

void append_forces(const DiffFindings& findings, std::string& out) {
  const auto& forces = findings.motion.forces();
  if (forces.empty()) return;
  TextTable table({{"CONTACT FORCE ON"},
                   {"BY MODEL OF"},
                   {"p50 N", kNumbers},
                   {"p99 N", kNumbers},
                   {"max N", kNumbers},
                   {"AT s", kNumbers}});
  std::size_t rows = 0;
  for (const auto& [key, force] : forces) {
    if (++rows > kMostRows) break;
    const peer::Spread newtons = force.histogram.spread();
    table.add({id_text({key[0], key[1], key[2]}), id_text({key[3], key[4], key[5]}),
               fmt::format("{:.3g}", newtons.p50), fmt::format("{:.3g}", newtons.p99),
               fmt::format("{:.4g}", force.max),
               fmt::format("{:.2f}", pdu::to_seconds(force.max_at))});
  }
  out += "\nDifference of the contact forces by the models on the wire, while in contact\n";
  out += table.text();
  append_and_more(out, forces.size(), kMostRows);
}

}  // namespace

void append_diff_text(const DiffFindings& findings, std::string& out) {
  append_captures(findings, out);
  append_verdict(findings, out);
  append_differences(findings.difference, out);
  append_types(findings.difference, out);
  append_entities(findings.difference, out);
  append_poses(findings, out);
  append_forces(findings, out);
}

}  // namespace reckon::tools
