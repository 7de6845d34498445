// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/leaders_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using Cell = std::pair<std::int32_t, std::int32_t>;

std::string name_of(const pdu::SimulationAddress& id) {
  return id == pdu::SimulationAddress{} ? "nobody" : fmt::format("{}:{}", id.site, id.application);
}

std::string json_name_of(const pdu::SimulationAddress& id) {
  return id == pdu::SimulationAddress{} ? "null" : '"' + name_of(id) + '"';
}

// The beacons that the peers follow, each once; found if any peer has found it.
std::string followed_text(std::span<const peer::PeerView* const> views) {
  std::map<std::string, std::string> places;
  for (const peer::PeerView* view : views) {
    const std::span followed(view->leaders.followed.data(), view->leaders.followed_count);
    for (const peer::LeadersView::Followed& one : followed) {
      std::string& place = places[one.name.data()];
      if (one.found) place = fmt::format("in cell {},{}", one.column, one.row);
      if (place.empty()) place = "nowhere";
    }
  }
  std::string text;
  for (const auto& [name, place] : places) text += fmt::format("; beacon {} {}", name, place);
  return text;
}

std::string followed_json(const peer::LeadersView& leaders) {
  if (leaders.followed_count == 0) return {};
  std::string rows;
  for (std::size_t i = 0; i < leaders.followed_count; ++i) {
    const peer::LeadersView::Followed& one = leaders.followed[i];
    const std::string cell =
        one.found ? fmt::format(R"("{},{}")", one.column, one.row) : std::string("null");
    rows += fmt::format(R"({}{{"beacon":"{}","cell":{},"group":{}}})", i == 0 ? "" : ",",
                        one.name.data(), cell, one.found ? one.group : 0);
  }
  return fmt::format(R"(,"followed":[{}])", rows);
}

}  // namespace

std::string leaders_text(std::span<const peer::PeerView* const> views) {
  std::set<std::string> scene;
  std::map<Cell, std::string> leader_of;
  const peer::LeadersView* mapped = nullptr;
  for (const peer::PeerView* view : views) {
    const peer::LeadersView& leaders = view->leaders;
    if (!leaders.on) return {};
    scene.insert(name_of(leaders.scene));
    if (mapped == nullptr || leaders.map_version > mapped->map_version) mapped = &leaders;
    for (std::size_t i = 0; i < leaders.count; ++i) {
      std::string& leader = leader_of[{leaders.rows[i].column, leaders.rows[i].row}];
      if (leader.empty() || leader == "nobody") leader = name_of(leaders.rows[i].leader);
    }
  }
  if (mapped == nullptr) return {};
  std::string text = fmt::format("scene by {}", fmt::join(scene, " and "));
  if (mapped->map_version > 0)
    text += fmt::format(", map {} has {}", mapped->map_version, counted(mapped->map_cells, "cell"));
  std::map<std::string, std::size_t> cells;
  for (const auto& [cell, leader] : leader_of) ++cells[leader];
  text += cells.empty() ? "" : "; cells";
  for (const auto& [leader, count] : cells) {
    text += fmt::format("{} by {}: {}", leader == cells.begin()->first ? "" : ",", leader, count);
  }
  return text + followed_text(views);
}

std::string leaders_json(const peer::LeadersView& leaders) {
  if (!leaders.on) return {};
  std::string cells;
  for (std::size_t i = 0; i < leaders.count; ++i) {
    const peer::LeadersView::Cell& cell = leaders.rows[i];
    cells += fmt::format(R"({}{{"cell":"{},{}","leader":{}}})", i == 0 ? "" : ",", cell.column,
                         cell.row, json_name_of(cell.leader));
  }
  return fmt::format(
      R"(,"leaders":{{"scene":{},"map_version":{},"map_cells":{},"cells":{},"led":{},)"
      R"("leaderless":{},"of":[{}]{}}})",
      json_name_of(leaders.scene), leaders.map_version, leaders.map_cells, leaders.cells,
      leaders.led, leaders.leaderless, cells, followed_json(leaders));
}

}  // namespace reckon::tools
