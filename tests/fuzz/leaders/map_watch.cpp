// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/map_watch.hpp"

#include <fmt/format.h>

#include <map>

#include "reckon/tests/fuzz/leaders/times.hpp"

namespace reckon::fuzz::leaders {
namespace {

// Two leaders have met, and one has taken over what the other says, after this.
constexpr nanoseconds kMet = std::chrono::seconds(3);

bool has_own_map(const SimulatedHost& host) {
  return host.role().leads(aoim::kWholeScene) && host.role().directory().leader() == host.epoch();
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

// Of cells in which somebody is: of others a leader gives the group back before it meets another.
std::set<std::uint16_t> MapWatch::contested(const std::vector<Place>& places) {
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
  return groups;
}

MapWatch::Sentence MapWatch::merged(const std::vector<Place>& places, nanoseconds now) {
  if (now < calm_) return {};
  if (!contested_) contested_ = contested(places);
  if (now < calm_ + kMet || now >= calm_ + kQuarantine) return {};
  for (const Place& place : places) {
    if (!place.host || !has_own_map(*place.host)) continue;
    for (const pdu::CellGroup& entry : place.host->role().directory().entries()) {
      if (contested_->count(entry.group) == 0) continue;
      return fmt::format("{:x} uses group {}, which two leaders gave to two cells",
                         place.host->epoch(), entry.group);
    }
  }
  return {};
}

}  // namespace reckon::fuzz::leaders
