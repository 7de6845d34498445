// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/map_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "reckon/tests/fuzz/leaders/times.hpp"

namespace reckon::fuzz::leaders {
namespace {

// Changes of a map are sent together, so a group looks used slightly longer than it is.
constexpr nanoseconds kSaidTogether = std::chrono::milliseconds(200);

}  // namespace

void MapRecord::blame(std::string sentence) {
  if (!fault_) fault_ = std::move(sentence);
}

void MapRecord::look(const aoim::LeaderRole& role, nanoseconds now) {
  const aoim::GroupDirectory& map = role.directory();
  const std::uint32_t own = role.leadership().epoch(), named = role.leader(aoim::kWholeScene);
  const bool leads = named == own;
  if (map.leader() != believed_ && map.leader() != own && map.leader() != named &&
      map.leader() != named_) {
    blame(fmt::format("has {:x}'s map and is led by {:x}", map.leader(), named));
  }
  if (!leads || map.leader() != own) {
    std::fill(inherited_.begin(), inherited_.end(), false);
    if (map.holds(now)) {
      for (const pdu::CellGroup& entry : map.entries()) inherited_[entry.group] = true;
    }
  }
  if (leads && !leads_) {
    began_ = now;
    had_map_ = believed_ != 0;
    // Its own earlier map, which it has not sent again, grants no group.
    version_.reset();
    if (map.leader() == own) version_ = map.version();
    std::fill(given_.begin(), given_.end(), Given());
  }
  leads_ = leads;
  named_ = named;
  believed_ = map.leader();
  if (!leads) return;
  heard_ = now;
  if (map.leader() == own && version_ != map.version()) note_given(role, now);
}

void MapRecord::note_given(const aoim::LeaderRole& role, nanoseconds now) {
  version_ = role.directory().version();
  if (*version_ <= said_) blame(fmt::format("says map {} after map {}", *version_, said_));
  said_ = *version_;
  std::vector<bool> used(given_.size());
  for (const pdu::CellGroup& entry : role.directory().entries()) {
    used[entry.group] = true;
    Given& given = given_[entry.group];
    const aoim::CellId cell{entry.column, entry.row};
    if (had_map_ && !inherited_[entry.group] && now - began_ < kQuarantine) {
      blame(fmt::format("gave group {} away {} ms after it began to lead", entry.group,
                        (now - began_) / std::chrono::milliseconds(1)));
    }
    const nanoseconds idle = given.used ? nanoseconds() : now - given.idle_since;
    if (given.cell && *given.cell != cell && idle < kQuarantine - kSaidTogether) {
      blame(fmt::format("gave group {} to another cell after {} ms", entry.group,
                        idle / std::chrono::milliseconds(1)));
    }
    given.cell = cell;
    given.used = true;
  }
  for (std::size_t group = 0; group < given_.size(); ++group) {
    Given& given = given_[group];
    if (given.used && !used[group]) given.idle_since = now;
    given.used = used[group];
  }
}

}  // namespace reckon::fuzz::leaders
