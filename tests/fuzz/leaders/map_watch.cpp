// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/map_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reckon/tests/fuzz/leaders/times.hpp"

namespace reckon::fuzz::leaders {
namespace {

// After this time two leaders have met, and one has adopted the other's map.
constexpr nanoseconds kMet = std::chrono::seconds(3);

bool has_own_map(const SimulatedHost& host) {
  return host.role().leads(aoim::kWholeScene) && host.role().directory().leader() == host.epoch();
}

// Checks any host: an earlier leader may still send its last map.
bool has_touched(const SimulatedHost& host, aoim::GroupIndex group, nanoseconds now) {
  bool has = false;
  const auto look = [&](aoim::GroupIndex one) { has = has || one == group; };
  host.role().pool().for_each([&](aoim::CellId, aoim::GroupIndex used) { look(used); });
  host.role().pool().for_each_resting(now, look);
  return has;
}

bool gives_elsewhere(const SimulatedHost& host, aoim::GroupIndex group, aoim::CellId cell) {
  bool gives = false;
  host.role().pool().for_each([&](aoim::CellId given, aoim::GroupIndex used) {
    gives = gives || (used == group && given != cell);
  });
  return gives;
}

}  // namespace

MapWatch::Sentence MapWatch::kept(const std::vector<Place>& places) {
  for (const Place& place : places) {
    if (!place.host || !place.host->maps().fault()) continue;
    return fmt::format("{:x} {}", place.host->epoch(), *place.host->maps().fault());
  }
  return {};
}

MapWatch::Sentence MapWatch::leases_end(const std::vector<Place>& places, nanoseconds now) {
  for (const Place& place : places) {
    if (!place.host || now < place.awake || place.host->role().leads(aoim::kWholeScene)) continue;
    if (now - place.host->maps().heard() < kLease) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) {
      if (!place.host->role().group(cell, now)) continue;
      return fmt::format("{:x} uses a group and has heard no map for {} ms", place.host->epoch(),
                         (now - place.host->maps().heard()) / std::chrono::milliseconds(1));
    }
  }
  return {};
}

// Only cells with members count: a leader takes back the groups of others before it meets another
// leader.
std::set<std::uint16_t> MapWatch::contested(const std::vector<Place>& places, nanoseconds now) {
  std::set<aoim::CellId> inhabited;
  for (const Place& place : places) {
    if (!place.host) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) inhabited.insert(cell);
  }
  std::map<std::uint16_t, aoim::CellId> cells;
  std::set<std::uint16_t> groups;
  for (const Place& place : places) {
    if (!place.host || !has_own_map(*place.host)) continue;
    for (const pdu::CellGroup& entry : place.host->role().directory().entries()) {
      const aoim::CellId cell{entry.column, entry.row};
      if (inhabited.count(cell) == 0) continue;
      if (cells.try_emplace(entry.group, cell).first->second != cell) groups.insert(entry.group);
    }
  }
  for (const Place& place : places) {
    if (!place.host || !has_own_map(*place.host)) continue;
    place.host->role().pool().for_each_resting(now + kMet, [&](aoim::GroupIndex group) {
      if (cells.count(group.value) > 0) groups.insert(group.value);
    });
  }
  return groups;
}

MapWatch::Sentence MapWatch::merged(const std::vector<Place>& places, nanoseconds now) {
  if (now < calm_) return {};
  if (!contested_) contested_ = contested(places, now);
  if (now < calm_ + kMet || now >= calm_ + kQuarantine) return {};
  for (const Place& place : places) {
    if (!place.host || !has_own_map(*place.host)) continue;
    for (const pdu::CellGroup& entry : place.host->role().directory().entries()) {
      if (contested_->count(entry.group) == 0) continue;
      return fmt::format("{:x} uses group {}, which two leaders gave or took", place.host->epoch(),
                         entry.group);
    }
  }
  return {};
}

std::vector<MapWatch::Own> MapWatch::own_groups(const std::vector<Place>& places, nanoseconds now) {
  std::vector<Own> own;
  for (const Place& place : places) {
    if (!place.host || !has_own_map(*place.host)) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) {
      const auto group = place.host->role().group(cell, now);
      const auto touched = [&](const Place& other) {
        return other.host && &other != &place && has_touched(*other.host, *group, now);
      };
      if (group && std::none_of(places.begin(), places.end(), touched))
        own.push_back({place.host->epoch(), cell, *group});
    }
  }
  return own;
}

MapWatch::Sentence MapWatch::nothing_lost(const std::vector<Place>& places, nanoseconds now) {
  if (now < calm_) return {};
  if (!own_) own_ = own_groups(places, now);
  std::erase_if(*own_, [&](const Own& own) {
    const auto leader = std::find_if(places.begin(), places.end(), [&own](const Place& place) {
      return place.host && place.host->epoch() == own.leader;
    });
    if (leader == places.end() || !has_own_map(*leader->host)) return true;
    return std::any_of(places.begin(), places.end(), [&](const Place& place) {
      return place.host && &place != &*leader && gives_elsewhere(*place.host, own.group, own.cell);
    });
  });
  for (const Own& own : *own_) {
    const auto leader = std::find_if(places.begin(), places.end(), [&own](const Place& place) {
      return place.host && place.host->epoch() == own.leader;
    });
    const auto cells = cells_of(*leader->host);
    const bool inside = std::find(cells.begin(), cells.end(), own.cell) != cells.end();
    if (!inside || leader->host->role().group(own.cell, now) == own.group) continue;
    return fmt::format("{:x} took group {} from {}, which nobody else had given away", own.leader,
                       own.group.value, name(own.cell));
  }
  return {};
}

}  // namespace reckon::fuzz::leaders
