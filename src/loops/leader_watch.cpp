// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/leader_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kNamedCells = 3;

aoim::PeerId peer_of(const aoim::AreaOfInterestManager& aoim, std::uint32_t epoch) noexcept {
  const aoim::Presence& presence = aoim.presence();
  if (epoch == presence.own().epoch) return presence.id();
  for (const aoim::Peer& peer : presence.peers()) {
    if (peer.announced.epoch == epoch) return peer.id();
  }
  return {};
}

// "peer 1:2", "this peer (1:3)", "nobody".
class LeaderName {
 public:
  LeaderName(const aoim::AreaOfInterestManager& aoim, std::uint32_t epoch) noexcept {
    const aoim::PeerId id = peer_of(aoim, epoch);
    const std::string_view who = epoch == 0                             ? "nobody"
                                 : epoch == aoim.presence().own().epoch ? "this peer, {}:{},"
                                                                        : "peer {}:{}";
    const auto written =
        fmt::format_to_n(text_.data(), text_.size(), fmt::runtime(who), id.site, id.application);
    size_ = static_cast<std::size_t>(written.out - text_.data());
  }
  [[nodiscard]] std::string_view view() const noexcept { return {text_.data(), size_}; }

 private:
  std::array<char, 32> text_{};
  std::size_t size_ = 0;
};

}  // namespace

LeaderWatch::LeaderWatch(Counters& counters, bool on) {
  view_.on = on;
  if (!on) return;
  changes_ = &counters.make("leader_changes", "changes of the leader of a cell or the scene");
  led_ = &counters.make_level("cells_led", "cells that this peer leads");
  map_version_ = &counters.make_level("group_map_version", "version of the map of groups in use");
  relayed_in_ =
      &counters.make("states_relayed_in", "states that leaders relayed to this peer as a newcomer");
  parts_out_ =
      &counters.make("snapshot_parts_out", "parts of snapshots that this peer sent as a leader");
}

void LeaderWatch::look(const aoim::AreaOfInterestManager& aoim, nanoseconds now,
                       haptics::SpscRing<Notice>& out) noexcept {
  if (aoim.leading() == nullptr || changes_ == nullptr) return;
  const aoim::LeaderRole& role = aoim.leading()->role();
  view_.cells = view_.led = view_.leaderless = view_.count = 0;
  for (Cell& cell : cells_) cell.present = false;
  role.leadership().for_each_cell(
      [&](aoim::CellId id, std::uint32_t leader) { note_cell(aoim, id, leader); });
  std::erase_if(cells_, [](const Cell& cell) { return !cell.present; });
  const aoim::GroupDirectory& directory = role.directory();
  const bool holds = directory.holds(now);
  view_.map_version = holds ? directory.version() : 0;
  view_.map_cells = holds ? directory.entries().size() : 0;
  led_->set(view_.led);
  map_version_->set(view_.map_version);
  parts_out_->set(role.server().parts_sent());

  const bool changed = std::any_of(cells_.begin(), cells_.end(),
                                   [](const Cell& cell) { return cell.leader != cell.reported; });
  if (!changed) tell_at_ = nanoseconds(-1);
  if (changed && tell_at_ < nanoseconds(0)) tell_at_ = now + kGather;
  if (!changed || now < tell_at_) return;
  for (const Cell& cell : cells_) {
    if (cell.leader != cell.reported) report_cells(aoim, cell.leader, out);
  }
  tell_at_ = nanoseconds(-1);
}

void LeaderWatch::note_cell(const aoim::AreaOfInterestManager& aoim, aoim::CellId id,
                            std::uint32_t leader) {
  auto cell = std::find_if(cells_.begin(), cells_.end(),
                           [id](const Cell& known) { return known.id == id; });
  if (cell == cells_.end()) cell = cells_.insert(cell, {id, 0, 0, false});
  cell->present = true;
  if (cell->leader != leader && leader != 0) changes_->add();
  cell->leader = leader;
  const aoim::PeerId peer = peer_of(aoim, leader);
  if (id == aoim::kWholeScene) {
    view_.scene = peer;
    return;
  }
  ++view_.cells;
  if (leader == aoim.presence().own().epoch) ++view_.led;
  if (leader == 0) ++view_.leaderless;
  if (view_.count < LeadersView::kCells) view_.rows[view_.count++] = {id.q, id.r, peer};
}

// One sentence for all cells that this leader newly leads, and one for the scene.
void LeaderWatch::report_cells(const aoim::AreaOfInterestManager& aoim, std::uint32_t leader,
                               haptics::SpscRing<Notice>& out) noexcept {
  const LeaderName name(aoim, leader);
  std::array<char, 64> cells{};
  char* end = cells.data();
  std::size_t count = 0;
  for (Cell& cell : cells_) {
    if (cell.leader != leader || cell.reported == leader) continue;
    cell.reported = leader;
    if (cell.id == aoim::kWholeScene) {
      static_cast<void>(
          out.push(make_notice(NoticeKind::leader, "the scene is led by {} now", name.view())));
      continue;
    }
    if (count++ >= kNamedCells) continue;
    const auto room = static_cast<std::size_t>(cells.data() + cells.size() - end);
    end = fmt::format_to_n(end, room, "{}{},{}", count > 1 ? " " : "", cell.id.q, cell.id.r).out;
  }
  if (count == 0) return;
  const std::string_view named(cells.data(), static_cast<std::size_t>(end - cells.data()));
  const std::size_t more = count - std::min(count, kNamedCells);
  static_cast<void>(out.push(
      count == 1 ? make_notice(NoticeKind::leader, "cell {} is led by {} now", named, name.view())
      : more > 0
          ? make_notice(NoticeKind::leader, "cells {} and {} more are led by {} now", named, more,
                        name.view())
          : make_notice(NoticeKind::leader, "cells {} are led by {} now", named, name.view())));
}

}  // namespace reckon::peer
