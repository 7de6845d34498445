// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/summary.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/command_line/duration_text.hpp"
#include "reckon/tools/command_line/size_text.hpp"
#include "reckon/tools/datagrams/selection.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;
using Align = TextTable::Align;

/// Greatest number of rows in text tables; JSON has all.
constexpr std::size_t kMaxRows = 20;
constexpr std::int64_t kSecond = 1'000'000'000;

std::string entity_text(pdu::EntityId id) {
  return fmt::format("{}:{}:{}", id.site, id.application, id.entity);
}

std::string utc_text(nanoseconds time) {
  const std::int64_t seconds = time.count() / kSecond;
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:09} UTC", fmt::gmtime(static_cast<time_t>(seconds)),
                     time.count() % kSecond);
}

std::string seconds_text(nanoseconds time) {
  return fmt::format("{}.{:09}", time.count() / kSecond, time.count() % kSecond);
}

/// Keys in descending order of their counts.
template <typename Map, typename Count>
std::vector<const typename Map::value_type*> by_count(const Map& map, Count&& count) {
  std::vector<const typename Map::value_type*> rows;
  for (const auto& row : map) rows.push_back(&row);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](auto* a, auto* b) { return count(a->second) > count(b->second); });
  return rows;
}

void append_rest(std::string& out, std::size_t size) {
  if (size > kMaxRows) out += fmt::format("... and {} more; --json has all\n", size - kMaxRows);
}

void append_shares(std::string& out, const auto& map, const char* title, const char* what,
                   auto&& name) {
  if (map.empty()) return;
  TextTable table({{title}, {what, Align::right}, {"OCTETS", Align::right}});
  const auto rows = by_count(map, [](const Share& share) { return share.count; });
  for (std::size_t i = 0; i < std::min(rows.size(), kMaxRows); ++i)
    table.add({name(rows[i]->first), fmt::format("{}", rows[i]->second.count),
               fmt::format("{}", rows[i]->second.octets)});
  out += '\n' + table.text();
  append_rest(out, rows.size());
}

void append_entities(std::string& out, const CaptureSummary& summary) {
  if (summary.entities.empty()) return;
  TextTable table({{"ENTITY"},
                   {"MARKING"},
                   {"PDUS", Align::right},
                   {"FIRST s", Align::right},
                   {"LAST s", Align::right}});
  const auto rows =
      by_count(summary.entities, [](const EntityShare& share) { return share.pdus.count; });
  for (std::size_t i = 0; i < std::min(rows.size(), kMaxRows); ++i) {
    const EntityShare& entity = rows[i]->second;
    table.add({entity_text(rows[i]->first), entity.marking, fmt::format("{}", entity.pdus.count),
               fmt::format("{:.3f}", pdu::to_seconds(entity.first)),
               fmt::format("{:.3f}", pdu::to_seconds(entity.last))});
  }
  out += '\n' + table.text();
  append_rest(out, rows.size());
}

void append_rules(std::string& out, const CaptureSummary& summary) {
  if (summary.rules.empty()) return;
  TextTable table({{"RULE"}, {"PDUS", Align::right}, {"FIRST FRAME", Align::right}});
  for (const auto& [rule, share] : summary.rules)
    table.add({rule, fmt::format("{}", share.count), fmt::format("{}", share.first_frame)});
  out += '\n' + table.text();
}

/// Adds a list of objects, one for each row; `members(object, name, share)` fills each.
void add_objects(JsonObject& to, std::string_view key, const auto& map, auto&& members) {
  to.array(key, map, [&](std::string& out, const auto& row) {
    JsonObject object(out);
    members(object, row.first, row.second);
    object.end();
  });
}

void add_share(JsonObject& to, std::string_view what, const Share& share) {
  to.value(what, share.count).value("octets", share.octets);
}

void add_endpoints(JsonObject& to, std::string_view key, std::string_view member,
                   const std::map<peer::IpEndpoint, Share>& map) {
  add_objects(to, key, map,
              [&](JsonObject& row, const peer::IpEndpoint& endpoint, const Share& share) {
                add_share(row.text(member, endpoint.text()), "datagrams", share);
              });
}

void add_entities(JsonObject& to, const CaptureSummary& summary) {
  add_objects(to, "entities", summary.entities,
              [](JsonObject& row, pdu::EntityId id, const EntityShare& e) {
                add_share(row.text("id", entity_text(id)).text("marking", e.marking), "pdus",
                          e.pdus);
                row.value("first", seconds_text(e.first)).value("last", seconds_text(e.last));
              });
}

double compression(const peer::SourceReport& report) {
  return static_cast<double>(report.compressed_content) /
         static_cast<double>(report.compressed_octets);
}

}  // namespace

double CaptureSummary::seconds() const {
  return first.has_value() ? pdu::to_seconds(*last - *first) : 0.0;
}

void CaptureSummary::add(const peer::SourceDatagram& datagram) {
  first = std::min(first.value_or(datagram.time), datagram.time);
  last = std::max(last.value_or(datagram.time), datagram.time);
  datagrams.add(datagram.bytes.size());
  if (!peer::is_headless(datagram.portion)) {
    senders[datagram.source].add(datagram.bytes.size());
    groups[datagram.group].add(datagram.bytes.size());
  }
  inspector_.inspect(datagram, [this](const PduRow& row) {
    add_pdu(row);
    return true;
  });
}

void CaptureSummary::add_pdu(const PduRow& row) {
  types[std::string(row.type())].add(row.bytes.size());
  if (!row.rule.empty()) {
    RuleShare& rule = rules[std::string(row.rule)];
    if (rule.count++ == 0) rule.first_frame = row.frame;
  }
  if (!row.id.has_value()) return;
  EntityShare& entity = entities[*row.id];
  entity.last = std::max(row.time - *first, nanoseconds{0});
  if (entity.pdus.count == 0) entity.first = entity.last;
  entity.pdus.add(row.bytes.size());
  if (row.header.pdu_type != pdu::PduType::entity_state) return;
  (void)pdu::visit(row.bytes, row.header, [&]<typename Pdu>(const Pdu& pdu) {
    if constexpr (std::same_as<Pdu, pdu::EntityState>) entity.marking = pdu.marking.view();
  });
}

std::string summary_text(const std::string& name, const CaptureSummary& summary,
                         const peer::SourceReport& report) {
  const InspectTally& tally = summary.tally();
  std::string out =
      fmt::format("{}: {}, {}, {} of payload\n", name, counted(summary.datagrams.count, "datagram"),
                  counted(tally.all_pdus(), "PDU"), size_text(summary.datagrams.octets));
  if (summary.first.has_value() && summary.last->count() > 0) {
    const double seconds = summary.seconds();
    out += fmt::format("from {}\nto   {}, {}", utc_text(*summary.first), utc_text(*summary.last),
                       duration_text(*summary.last - *summary.first));
    if (seconds > 0)
      out += fmt::format(", {:.4g} datagrams/s",
                         static_cast<double>(summary.datagrams.count) / seconds);
    out += '\n';
  }
  if (report.compressed_octets > 0)
    out += fmt::format(
        "compressed by {}: {} hold {}, {:.3g} times less{}\n", report.compression,
        size_text(report.compressed_octets), size_text(report.compressed_content),
        compression(report),
        report.zstd_frames > 0 ? ", " + counted(report.zstd_frames, "zstd frame") : std::string());
  if (report.fragments.whole > 0)
    out += fmt::format("{} reassembled from IP fragments\n",
                       counted(report.fragments.whole, "datagram"));
  if (tally.foreign > 0)
    out += fmt::format("{} of other protocols\n", counted(tally.foreign, "datagram"));
  const std::string damage = damage_text(report);
  if (!damage.empty()) out += fmt::format("damage: {}\n", damage);
  if (report.skipped > 0) out += fmt::format("{} without UDP\n", counted(report.skipped, "frame"));
  append_shares(out, summary.types, "TYPE", "PDUS", [](const std::string& type) { return type; });
  const auto endpoint = [](const peer::IpEndpoint& value) { return value.text(); };
  append_shares(out, summary.senders, "SENDER", "DATAGRAMS", endpoint);
  append_shares(out, summary.groups, "SENT TO", "DATAGRAMS", endpoint);
  append_entities(out, summary);
  append_rules(out, summary);
  return out;
}

std::string summary_json(const std::string& name, const CaptureSummary& summary,
                         const peer::SourceReport& report) {
  const InspectTally& tally = summary.tally();
  std::string out;
  JsonObject line(out);
  line.text("file", name)
      .value("frames", report.frames)
      .value("datagrams", summary.datagrams.count)
      .value("octets", summary.datagrams.octets)
      .value("first", seconds_text(summary.first.value_or(nanoseconds{0})))
      .value("last", seconds_text(summary.last.value_or(nanoseconds{0})))
      .value("pdus", tally.all_pdus())
      .value("ok", tally.of(PduStatus::ok))
      .value("notes", tally.of(PduStatus::note))
      .value("warnings", tally.of(PduStatus::warning))
      .value("errors", tally.of(PduStatus::error))
      .value("foreign", tally.foreign)
      .text("compression", report.compression)
      .value("compressed_octets", report.compressed_octets)
      .value("compressed_content", report.compressed_content)
      .value("zstd_frames", report.zstd_frames)
      .value("fragments", report.fragments.frames)
      .value("reassembled", report.fragments.whole)
      .value("incomplete", report.fragments.lost)
      .value("overlapping", report.fragments.overlapping)
      .value("late_fragments", report.fragments.late)
      .value("duplicate_fragments", report.fragments.duplicate)
      .value("cut", report.cut)
      .value("malformed", report.malformed)
      .value("skipped", report.skipped)
      .text("problem", report.problem);
  add_objects(line, "types", summary.types,
              [](JsonObject& row, const std::string& type, const Share& share) {
                add_share(row.text("type", type), "pdus", share);
              });
  add_endpoints(line, "senders", "sender", summary.senders);
  add_endpoints(line, "groups", "group", summary.groups);
  add_entities(line, summary);
  add_objects(
      line, "rules", summary.rules,
      [](JsonObject& row, const std::string& rule, const RuleShare& share) {
        row.text("rule", rule).value("pdus", share.count).value("first_frame", share.first_frame);
      });
  line.end("\n");
  return out;
}

}  // namespace reckon::tools
