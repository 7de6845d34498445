// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/top/panes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/tools/inspect/check/rules.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/inspect/top/columns.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

constexpr std::size_t kPlotRows = 6;

std::string vector_text(const auto& v, std::string_view unit) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) {}", v.x, v.y, v.z, unit);
}

/// "first 1  threshold 12  heartbeat 3".
std::string causes_text(const EntityRow& row) {
  std::string text;
  for (std::size_t i = 1; i < kUpdateCauses; ++i) {
    if (row.causes[i] == 0) continue;
    if (!text.empty()) text += "  ";
    text += fmt::format("{} {}", name(static_cast<UpdateCause>(i)), row.causes[i]);
  }
  return text;
}

std::string jumps_text(const EntityRow& row) {
  if (row.jumps.count() == 0) return "none yet";
  return fmt::format("last {}  p50 {}  p99 {}  max {} in frame {}  of {}", distance_text(row.jump),
                     distance_text(row.jumps.percentile(0.5)),
                     distance_text(row.jumps.percentile(0.99)), distance_text(row.jumps.max()),
                     row.worst_frame, row.jumps.count());
}

std::string turns_text(const EntityRow& row) {
  if (row.turns.count() == 0) return "none yet";
  return fmt::format("last {}  p50 {}  p99 {}  max {}", angle_text(row.turn),
                     angle_text(row.turns.percentile(0.5)), angle_text(row.turns.percentile(0.99)),
                     angle_text(row.turns.max()));
}

void add_plot(const EntityRow& row, std::size_t columns, std::vector<ScreenLine>& out) {
  std::vector<double> jumps = row.recent_jumps();
  if (jumps.size() > columns) jumps.erase(jumps.begin(), jumps.end() - static_cast<long>(columns));
  if (jumps.empty()) return;
  const double largest = *std::max_element(jumps.begin(), jumps.end());
  out.push_back({});
  out.push_back({fmt::format("last {} jumps, the largest {}", jumps.size(), distance_text(largest)),
                 LineStyle::title});
  for (std::string& line : bar_plot(jumps, kPlotRows)) out.push_back({std::move(line)});
}

void add_motion(const pdu::EntityState& pdu, std::vector<ScreenLine>& out) {
  const auto& reckoning = pdu.dead_reckoning;
  out.push_back({"location      " + vector_text(pdu.location, "m")});
  out.push_back({"velocity      " + vector_text(pdu.linear_velocity, "m/s")});
  out.push_back({fmt::format("orientation   ({:.4f}, {:.4f}, {:.4f}) rad", pdu.orientation.psi,
                             pdu.orientation.theta, pdu.orientation.phi)});
  out.push_back({"acceleration  " + vector_text(reckoning.linear_acceleration, "m/s^2")});
  out.push_back({"turns by      " + vector_text(reckoning.angular_velocity, "rad/s")});
  out.push_back({fmt::format("appearance    0x{:08X}   capabilities 0x{:08X}", pdu.appearance,
                             pdu.capabilities)});
}

}  // namespace

std::vector<std::string> bar_plot(std::span<const double> values, std::size_t rows) {
  const double largest = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  std::vector<std::string> lines(rows, std::string(values.size(), ' '));
  for (std::size_t i = 0; i < values.size() && largest > 0; ++i) {
    const double height = values[i] / largest * static_cast<double>(rows);
    const auto full = static_cast<std::size_t>(std::floor(height + 1e-9));
    for (std::size_t row = 0; row < full; ++row) lines[rows - 1 - row][i] = '#';
    if (full == 0 && values[i] > 0) lines[rows - 1][i] = '.';
  }
  return lines;
}

std::vector<ScreenLine> entity_pane(const TopCell& cell, std::size_t columns) {
  const ReceivedEntity& entity = cell.entity;
  const EntityRow& row = cell.row;
  const std::vector<std::string> cells = top_cells(cell);
  const pdu::EntityState pdu = entity.entity_state();
  std::vector<ScreenLine> out;
  out.push_back({fmt::format("{}  {}", id_text(entity.id), printable_text(pdu.marking.view())),
                 LineStyle::title});
  const auto columns_of = top_columns();
  std::string line;
  for (std::size_t i = 2; i < cells.size(); ++i) {
    const std::string item = fmt::format("{} {}", columns_of[i].title, cells[i]);
    if (!line.empty() && line.size() + item.size() + 3 > columns) {
      out.push_back({std::move(line)});
      line.clear();
    }
    line += line.empty() ? item : "   " + item;
  }
  out.push_back({std::move(line)});
  out.push_back({});
  out.push_back({"type          " + peer::entity_type_numbers(pdu.entity_type)});
  if (entity.has_state) add_motion(pdu, out);
  out.push_back({fmt::format("updates       {}: {}", entity.updates, causes_text(row))});
  out.push_back({"jumps         " + jumps_text(row)});
  out.push_back({"turned by     " + turns_text(row)});
  add_plot(row, columns, out);
  return out;
}

std::vector<ScreenLine> bundles_pane(const TopData& data) {
  std::vector<ScreenLine> out;
  out.push_back({fmt::format("{}: {:.2f} PDUs each, {:.1f} % of the octets on the wire are PDUs",
                             counted(data.totals.datagrams, "datagram"),
                             data.totals.pdus_per_datagram(), 100 * data.totals.efficiency()),
                 LineStyle::title});
  for (std::size_t i = 0; i < data.bundle_sizes.size(); ++i) {
    const std::uint64_t count = data.bundle_sizes[i];
    if (count == 0) continue;
    const double share = static_cast<double>(count) / static_cast<double>(data.totals.datagrams);
    const bool last = i + 1 == data.bundle_sizes.size();
    out.push_back(
        {fmt::format("{:>3}{} PDUs  {:>9} datagrams  {:>5.1f} %  {}", i, last ? "+" : " ", count,
                     100 * share, std::string(static_cast<std::size_t>(40 * share), '#'))});
  }
  return out;
}

std::vector<ScreenLine> faults_pane(const TopData& data) {
  std::vector<ScreenLine> out;
  out.push_back({fmt::format("{} that broke an octet rule; reckon inspect check has all rules",
                             counted(data.totals.errors, "PDU")),
                 LineStyle::title});
  for (const auto& [rule, count] : data.faults) {
    const CheckRule* known = find_check_rule(rule);
    out.push_back({fmt::format("{:>8}  {:<16} {}", count, rule, known ? known->sentence : ""),
                   rule.starts_with("E") ? LineStyle::bad : LineStyle::plain});
    if (known != nullptr) out.push_back({fmt::format("{:>27}fix: {}", "", known->remedy)});
  }
  if (data.faults.empty()) out.push_back({"none"});
  return out;
}

}  // namespace reckon::tools
