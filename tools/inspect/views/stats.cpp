// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/views/stats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reckon/pdu/type_names.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

constexpr std::array<std::string_view, 4> kTables{"type", "sender", "group", "entity"};
constexpr std::size_t kRowsInText = 20;
constexpr std::size_t kUnreadable = 256;
void add(TrafficShare& to, const TrafficShare& share) {
  to.pdus += share.pdus;
  to.octets += share.octets;
  to.datagrams += share.datagrams;
  to.errors += share.errors;
  to.lost += share.lost;
}

bool has_datagrams(std::string_view by) { return by == "sender" || by == "group"; }

/// A rate per second; null and "-" if no time passed.
std::string rate(double count, double seconds, Format format) {
  if (seconds > 0)
    return format == Format::text ? fmt::format("{:.1f}", count / seconds)
                                  : json_number(count / seconds);
  if (format == Format::csv) return "";
  return format == Format::json ? "null" : "-";
}

}  // namespace

StatsView::StatsView(Format format, std::string by, std::size_t most_rows)
    : format_(format), by_(std::move(by)), most_rows_(most_rows), motion_(most_rows) {}

template <typename Key>
TrafficShare& StatsView::row_of(Table<Key>& table, const Key& key) const {
  const auto found = table.rows.find(key);
  if (found != table.rows.end()) return found->second;
  return table.rows.size() < most_rows_ ? table.rows[key] : table.others;
}

void StatsView::pdu(const peer::SourceDatagram& datagram, const PduRow& row,
                    std::chrono::nanoseconds, std::string&) {
  const bool broken = row.status == PduStatus::error;
  const TrafficShare share{1, row.bytes.size(), 0, broken ? 1U : 0U, 0};
  add(types_[row.has_header ? static_cast<std::size_t>(row.header.pdu_type) : kUnreadable], share);
  if (row.id.has_value()) add(row_of(entities_, *row.id), share);
  if (shows("entity")) motion_.take_pdu(row, datagram);
  add(datagram_, share);
  totals_.count(row);
  loss_.pdu(row);
}

void StatsView::datagram(const peer::SourceDatagram& datagram, std::chrono::nanoseconds,
                         std::string&) {
  totals_.count(datagram);
  datagram_.datagrams = 1;
  datagram_.lost = loss_.datagram(datagram);
  add(row_of(senders_, datagram.source), datagram_);
  add(row_of(groups_, datagram.group), datagram_);
  datagram_ = {};
}

StatsView::Rows StatsView::rows(std::string_view by) const {
  Rows rows;
  const auto take = [&](const auto& table, auto name) {
    for (const auto& [key, share] : table.rows) rows.push_back({name(key), share, {}});
    if (table.others.pdus > 0) rows.push_back({"others", table.others, {}});
  };
  const auto endpoint_name = [](const peer::IpEndpoint& endpoint) {
    return endpoint.is_unspecified() ? "-" : endpoint.text();
  };
  if (by == "sender") take(senders_, endpoint_name);
  if (by == "group") take(groups_, endpoint_name);
  if (by == "entity") take(entities_, id_text);
  for (std::size_t type = 0; by == "type" && type < types_.size(); ++type) {
    if (types_[type].pdus == 0) continue;
    const std::string_view name =
        type == kUnreadable ? "unreadable" : pdu::snake_name(static_cast<pdu::PduType>(type));
    rows.push_back({std::string(name), types_[type], {}});
  }
  if (by == "entity") add_jumps(rows);
  std::sort(rows.begin(), rows.end(), [](const NamedShare& a, const NamedShare& b) {
    return a.share.pdus != b.share.pdus ? a.share.pdus > b.share.pdus : a.key < b.key;
  });
  return rows;
}

// The same ID in several exercises has one row.
void StatsView::add_jumps(Rows& rows) const {
  std::unordered_map<std::string, Jumps> greatest;
  for (std::size_t i = 0; i < motion_.rows().size(); ++i) {
    const EntityRow& row = motion_.rows()[i];
    if (row.jumps.count() == 0) continue;
    Jumps& jumps = greatest[id_text(motion_.entities()[i].id)];
    jumps.metres = std::max(jumps.metres, row.jumps.max());
    jumps.degrees = std::max(jumps.degrees, row.turns.max());
  }
  for (NamedShare& row : rows)
    if (const auto found = greatest.find(row.key); found != greatest.end())
      row.jumps = found->second;
}

void StatsView::finish(const InspectTally&, std::string& out) {
  if (format_ == Format::csv)
    out +=
        "by,key,pdus,octets,pdus_per_s,octets_per_s,datagrams,errors,lost,jump_max_m,"
        "jump_max_deg\n";
  if (format_ == Format::text) return text(out);
  for (const std::string_view table : kTables) {
    if (!shows(table)) continue;
    if (format_ == Format::json) json_table(table, out);
    if (format_ == Format::csv) csv_table(table, out);
  }
  if (format_ == Format::json) json_totals(out);
}

void StatsView::text(std::string& out) const {
  const aoim::SequenceCounts& sequences = loss_.counts();
  const double seconds = totals_.seconds();
  fmt::format_to(end_of(out), "{} in {}, {:.3f} s: {} PDU/s, {} datagrams/s, {} octets/s\n",
                 counted(totals_.pdus, "PDU"), counted(totals_.datagrams, "datagram"), seconds,
                 rate(static_cast<double>(totals_.pdus), seconds, format_),
                 rate(static_cast<double>(totals_.datagrams), seconds, format_),
                 rate(static_cast<double>(totals_.octets), seconds, format_));
  fmt::format_to(end_of(out),
                 "{:.2f} PDUs a datagram; {:.1f} % of the octets on the wire are PDUs; ",
                 totals_.pdus_per_datagram(), 100 * totals_.efficiency());
  if (sequences.received == 0)
    out += "no trailers, so loss is unknown\n";
  else
    fmt::format_to(end_of(out), "{} lost of {}, {} late, {} twice\n", sequences.lost,
                   sequences.received - sequences.duplicated + sequences.lost, sequences.reordered,
                   sequences.duplicated);
  for (const std::string_view table : kTables) {
    if (shows(table)) text_table(table, by_.empty() ? kRowsInText : SIZE_MAX, out);
  }
}

void StatsView::text_table(std::string_view by, std::size_t most, std::string& out) const {
  constexpr auto kRight = TextTable::Align::right;
  std::vector<TextTable::Column> columns{{fmt::format("BY {}", by), TextTable::Align::left},
                                         {"PDUs", kRight},
                                         {"PDU/s", kRight},
                                         {"OCTETS", kRight},
                                         {"OCTET/s", kRight},
                                         {"ERRORS", kRight}};
  std::transform(columns[0].title.begin(), columns[0].title.end(), columns[0].title.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  if (has_datagrams(by)) {
    columns.push_back({"DATAGRAMS", kRight});
    columns.push_back({"LOST", kRight});
  }
  if (by == "entity") {
    columns.push_back({"JUMP max", kRight});
    columns.push_back({"TURN max", kRight});
  }
  TextTable table(columns);
  const Rows all = rows(by);
  const double seconds = totals_.seconds();
  const bool known = loss_.counts().received > 0;
  for (std::size_t i = 0; i < std::min(all.size(), most); ++i) {
    const TrafficShare& share = all[i].share;
    std::vector<std::string> cells{all[i].key,
                                   fmt::format("{}", share.pdus),
                                   rate(static_cast<double>(share.pdus), seconds, format_),
                                   fmt::format("{}", share.octets),
                                   rate(static_cast<double>(share.octets), seconds, format_),
                                   fmt::format("{}", share.errors)};
    if (has_datagrams(by)) {
      cells.push_back(fmt::format("{}", share.datagrams));
      cells.push_back(known ? fmt::format("{}", share.lost) : "-");
    }
    if (by == "entity") {
      const auto& jumps = all[i].jumps;
      cells.push_back(jumps.has_value() ? distance_text(jumps->metres) : "-");
      cells.push_back(jumps.has_value() ? angle_text(jumps->degrees) : "-");
    }
    table.add(std::move(cells));
  }
  if (table.empty()) return;
  out += '\n';
  out += table.text();
  if (all.size() > most)
    fmt::format_to(end_of(out), "and {} more: --by {} shows all\n", all.size() - most, by);
}

void StatsView::json_table(std::string_view by, std::string& out) const {
  const double seconds = totals_.seconds();
  for (const auto& [key, share, jumps] : rows(by)) {
    JsonObject line(out);
    line.text("by", by)
        .text("key", key)
        .value("pdus", share.pdus)
        .value("octets", share.octets)
        .value("pdus_per_s", rate(static_cast<double>(share.pdus), seconds, format_))
        .value("octets_per_s", rate(static_cast<double>(share.octets), seconds, format_))
        .value("errors", share.errors);
    if (has_datagrams(by)) line.value("datagrams", share.datagrams).value("lost", share.lost);
    if (jumps.has_value())
      line.value("jump_max_m", json_number(jumps->metres))
          .value("jump_max_deg", json_number(jumps->degrees));
    line.end("\n");
  }
}

void StatsView::json_totals(std::string& out) const {
  const aoim::SequenceCounts& sequences = loss_.counts();
  const double seconds = totals_.seconds();
  JsonObject(out)
      .text("by", "all")
      .value("pdus", totals_.pdus)
      .value("datagrams", totals_.datagrams)
      .decimals("seconds", seconds, 9)
      .value("pdu_octets", totals_.pdu_octets)
      .value("octets", totals_.octets)
      .value("wire_octets", totals_.wire_octets)
      .value("errors", totals_.errors)
      .value("pdus_per_s", rate(static_cast<double>(totals_.pdus), seconds, format_))
      .value("octets_per_s", rate(static_cast<double>(totals_.octets), seconds, format_))
      .value("pdus_per_datagram", json_number(totals_.pdus_per_datagram()))
      .value("efficiency", json_number(totals_.efficiency()))
      .value("with_trailer", sequences.received)
      .value("lost", sequences.lost)
      .value("late", sequences.reordered)
      .value("duplicated", sequences.duplicated)
      .end("\n");
}

void StatsView::csv_table(std::string_view by, std::string& out) const {
  const double seconds = totals_.seconds();
  for (const auto& [key, share, jumps] : rows(by)) {
    fmt::format_to(end_of(out), "{},", by);
    append_csv_cell(out, key);
    fmt::format_to(end_of(out), ",{},{},{},{},", share.pdus, share.octets,
                   rate(static_cast<double>(share.pdus), seconds, format_),
                   rate(static_cast<double>(share.octets), seconds, format_));
    if (has_datagrams(by))
      fmt::format_to(end_of(out), "{},{},{}", share.datagrams, share.errors, share.lost);
    else
      fmt::format_to(end_of(out), ",{},", share.errors);
    out += jumps.has_value()
               ? fmt::format(",{},{}\n", json_number(jumps->metres), json_number(jumps->degrees))
               : ",,\n";
  }
}

namespace view {

InspectViewKind stats() {
  return {"stats", "counts by PDU type, sender, group and entity", true,
          [](const InspectOptions& options, const Console&) -> std::unique_ptr<View> {
            return std::make_unique<StatsView>(options.format(), options.by);
          }};
}

}  // namespace view
}  // namespace reckon::tools
