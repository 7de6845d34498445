// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/top/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/inspect/top/columns.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::tools {
namespace {

constexpr double kShareToTell = 0.5;
constexpr std::size_t kFewEntities = 4;

/// "1" or "1 and 2 more".
std::string exercise_text(const std::bitset<256>& exercises) {
  std::size_t first = 0;
  while (first < exercises.size() && !exercises[first]) ++first;
  if (first == exercises.size()) return "-";
  if (exercises.count() == 1) return fmt::format("{}", first);
  return fmt::format("{} and {} more", first, exercises.count() - 1);
}

/// "0:42".
std::string span_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::max(seconds, 0.0));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

/// Traffic of the simulation with the most octets.
struct Spender {
  std::uint64_t octets = 0;
  std::size_t entities = 0;
  double jump = 0;  // the largest p99 of its entities [m]
};

}  // namespace

std::string top_head(const TopData& data, const TrafficRates::Rates& rates) {
  const double elapsed =
      data.totals.datagrams == 0
          ? 0
          : pdu::to_seconds(std::max(data.now, data.totals.last) - data.totals.first);
  return fmt::format(
      "{}{}   ex {}   {}   {:.0f} PDU/s   {:.0f} dgram/s   {:.2f} Mbit/s   {:.1f} PDU/dgram = "
      "{:.1f} "
      "% payload   lost {}   bad {}",
      data.source, data.interfaces.empty() ? "" : "   on " + data.interfaces,
      exercise_text(data.exercises), span_text(elapsed), rates.pdus, rates.datagrams,
      1e-6 * rates.bits, data.totals.pdus_per_datagram(), 100 * data.totals.efficiency(),
      data.loss.counts().lost + data.dropped, data.totals.errors);
}

std::string top_advice(const TopData& data) {
  if (data.entities.rows().size() < kFewEntities) return "";
  std::unordered_map<std::uint32_t, Spender> spenders;
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < data.entities.rows().size(); ++i) {
    const EntityRow& row = data.entities.rows()[i];
    const pdu::EntityId& id = data.entities.entities()[i].id;
    Spender& spender = spenders[std::uint32_t{id.site} << 16 | id.application];
    spender.octets += row.octets;
    spender.jump = std::max(spender.jump, row.jumps.percentile(0.99));
    ++spender.entities;
    all += row.octets;
  }
  const auto most = std::max_element(
      spenders.begin(), spenders.end(),
      [](const auto& a, const auto& b) { return a.second.octets < b.second.octets; });
  const double share = static_cast<double>(most->second.octets) /
                       static_cast<double>(std::max<std::uint64_t>(all, 1));
  if (spenders.size() < 2 || share < kShareToTell) return "";
  return fmt::format(
      "{}:{}:* sends {:.0f} % of the octets of entities, and 99 % of its jumps are below {}",
      most->first >> 16, most->first & 0xFFFFU, 100 * share, distance_text(most->second.jump));
}

void append_top_text(std::string& out, const TopData& data, const TrafficRates::Rates& rates) {
  out += top_head(data, rates);
  out += '\n';
  std::vector<TextTable::Column> titles;
  for (const TopColumn& column : top_columns())
    titles.push_back({std::string(column.title), column.align});
  TextTable table(titles);
  for (const std::size_t place : top_order(data.entities, data.now, 0))
    table.add(top_cells({data.entities, place, data.now}));
  if (!table.empty()) out += table.text();
  if (data.entities.others() > 0)
    fmt::format_to(end_of(out), "others: {} PDUs of entities beyond {}\n", data.entities.others(),
                   data.entities.rows().size());
  if (const std::string advice = top_advice(data); !advice.empty()) out += advice + '\n';
}

void append_top_json(std::string& out, const TopData& data, const TrafficRates::Rates& rates) {
  for (const std::size_t place : top_order(data.entities, data.now, 0)) {
    const TopCell cell{data.entities, place, data.now};
    out += "{\"time\":";
    append_time(out, data.now);
    for (const TopMember& member : top_members()) {
      const std::string value = member.value(cell);
      if (member.is_text && !value.empty())
        append_json_member(out, member.key, value);
      else
        fmt::format_to(end_of(out), ",\"{}\":{}", member.key, value.empty() ? "null" : value);
    }
    out += "}\n";
  }
  out += "{\"summary\":\"top\",\"time\":";
  append_time(out, data.now);
  fmt::format_to(
      end_of(out),
      ",\"entities\":{},\"others\":{},\"pdus\":{},\"datagrams\":{},\"seconds\":{:.9f},"
      "\"pdus_per_s\":{},\"datagrams_per_s\":{},\"bits_per_s\":{},\"pdus_per_datagram\":{},"
      "\"efficiency\":{},\"lost\":{},\"dropped\":{},\"bad\":{}}}\n",
      data.entities.rows().size(), data.entities.others(), data.totals.pdus, data.totals.datagrams,
      data.totals.seconds(), json_number(rates.pdus), json_number(rates.datagrams),
      json_number(rates.bits), json_number(data.totals.pdus_per_datagram()),
      json_number(data.totals.efficiency()), data.loss.counts().lost, data.dropped,
      data.totals.errors);
}

void append_top_csv(std::string& out, const TopData& data) {
  bool first = true;
  for (const TopMember& member : top_members()) {
    if (!first) out += ',';
    first = false;
    out += member.key;
  }
  out += '\n';
  for (const std::size_t place : top_order(data.entities, data.now, 0)) {
    const TopCell cell{data.entities, place, data.now};
    first = true;
    for (const TopMember& member : top_members()) {
      if (!first) out += ',';
      first = false;
      append_csv_cell(out, member.value(cell));
    }
    out += '\n';
  }
}

}  // namespace reckon::tools
