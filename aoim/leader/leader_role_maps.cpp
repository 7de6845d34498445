// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The scene leader's part of LeaderRole: assigns groups to occupied cells, and publishes the map of
// groups and beacons.
#include <algorithm>
#include <array>

#include "reckon/aoim/leader/leader_role.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// A new map is repeated so often, a heartbeat apart, before it is used for sending.
constexpr int kMoreMaps = 3;

}  // namespace

void LeaderRole::note_own_cells(nanoseconds now) {
  for (const auto& [cell, group] : entered_) note_populated(cell, now);
  for (const CarriedBeacon& beacon : carried_) {
    if (entered_.count(beacon.cell) == 0) continue;
    changed_ |= beacons_.receive(beacon.tag, beacon.cell, leadership_.epoch(), now);
  }
}

// Assigns groups to occupied cells, and takes back the groups of cells that have long been empty.
void LeaderRole::hand_out(nanoseconds now) {
  if (now < next_hand_out_) return;
  next_hand_out_ = now + kMapGap;
  note_own_cells(now);
  changed_ |= beacons_.expire(now);
  const std::size_t before = pool_.in_use();
  for (auto it = populated_.begin(); it != populated_.end();) {
    if (now - it->second < config_.empty) {
      ++it;
      continue;
    }
    pool_.give_back(it->first, now);
    it = populated_.erase(it);
  }
  changed_ = changed_ || pool_.in_use() != before;
  for (const auto& [cell, heard] : populated_) {
    const std::size_t had = pool_.in_use();
    static_cast<void>(pool_.take(cell, now));
    changed_ = changed_ || pool_.in_use() != had;
  }
}

// Rows of cells with their groups, and of beacons: the first beacon of a cell is in its row;
// others, and beacons of cells without a group, have rows with group 0.
std::vector<pdu::CellGroup> LeaderRole::map_rows(nanoseconds now) const {
  std::vector<pdu::CellGroup> rows;
  std::map<CellId, std::size_t> places;
  pool_.for_each([&](CellId cell, GroupIndex group) {
    places[cell] = rows.size();
    rows.push_back({cell.q, cell.r, 0, group.value, 0});
  });
  // The new leader must not reuse groups that our map may still use.
  if (!leads(kWholeScene)) {
    pool_.for_each_resting(now, [&](GroupIndex group) { rows.push_back(resting_row(group)); });
    return rows;
  }
  beacons_.for_each([&](std::uint32_t tag, CellId cell) {
    const auto place = places.find(cell);
    if (place != places.end() && rows[place->second].beacon == 0) {
      rows[place->second].beacon = tag;
    } else {
      rows.push_back({cell.q, cell.r, tag, kBaseGroup.value, 0});
    }
  });
  return rows;
}

void LeaderRole::publish(nanoseconds now, const LeaderSignature& signature, const Send& send) {
  if (changed_) ++version_;
  if (changed_) more_maps_ = config_.hand_out ? kMoreMaps : 0;
  changed_ = false;
  last_map_ = now;
  next_map_ = now + (more_maps_ > 0 ? config_.heartbeat : config_.refresh);
  more_maps_ = std::max(0, more_maps_ - 1);
  std::vector<pdu::CellGroup> rows = map_rows(now);
  send_map(rows, signature, send);
  if (leads(kWholeScene)) directory_.set(std::move(rows), version_, leadership_.epoch(), now);
}

void LeaderRole::send_map(std::span<const pdu::CellGroup> rows, const LeaderSignature& signature,
                          const Send& send) {
  std::vector<std::byte> octets(rows.size() * pdu::kFixedSize<pdu::CellGroup>);
  std::span<std::byte> place(octets);
  for (const pdu::CellGroup& row : rows) {
    static_cast<void>(pdu::store_record(row, place));
    place = place.subspan(pdu::kFixedSize<pdu::CellGroup>);
  }
  constexpr std::size_t kPart = GroupDirectory::kPerPart * pdu::kFixedSize<pdu::CellGroup>;
  pdu::GroupMap map;
  sign(map, signature);
  map.version = version_;
  map.pool = static_cast<std::uint16_t>(groups_);
  map.parts =
      static_cast<std::uint16_t>(std::max<std::size_t>(1, (octets.size() + kPart - 1) / kPart));
  for (; map.part < map.parts; ++map.part) {
    const auto rest = std::span<const std::byte>(octets).subspan(map.part * kPart);
    map.groups = rest.first(std::min(rest.size(), kPart));
    std::array<std::byte, pdu::kFixedSize<pdu::GroupMap> + kPart> part;
    send(kBaseGroup, std::span(part).first(pdu::encode(map, part)));
  }
}

nanoseconds LeaderRole::next_step() const noexcept {
  nanoseconds next = std::min({leadership_.next_step(), server_.next_step(), reader_.next_step()});
  if (leads(kWholeScene)) {
    return std::min({next, next_hand_out_, changed_ ? last_map_ + kMapGap : next_map_});
  }
  if (config_.hand_out && heard_mapped_) {
    next = std::min(next, std::max({next_map_ask_, directory_.lease_end()}));
  }
  return last_maps_ > 0 ? std::min(next, next_map_) : next;
}

}  // namespace reckon::aoim
