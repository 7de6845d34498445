// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/group_directory.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <tuple>
#include <utility>

#include "reckon/aoim/leader/group_pool.hpp"

namespace reckon::aoim {
namespace {

bool by_cell(const pdu::CellGroup& a, const pdu::CellGroup& b) noexcept {
  return std::tie(a.column, a.row) < std::tie(b.column, b.row);
}

}  // namespace

using std::chrono::nanoseconds;

GroupDirectory::GroupDirectory(std::size_t pool, nanoseconds lease) : pool_(pool), lease_(lease) {}

// False when a cell, a group or a beacon occurs twice, or when a group is not in the pool.
bool GroupDirectory::is_sound(std::span<const pdu::CellGroup> rows) const {
  std::vector<bool> seen(pool_ + 1);
  std::vector<std::uint32_t> tags;
  std::vector<CellId> cells;
  for (const pdu::CellGroup& row : rows) {
    if (row.beacon != 0) tags.push_back(row.beacon);
    if (row.group == 0 && row.beacon != 0) continue;
    if (row.group < 1 || row.group > pool_ || seen[row.group]) return false;
    seen[row.group] = true;
    cells.push_back({row.column, row.row});
  }
  const auto has_twins = [](auto& values) {
    std::sort(values.begin(), values.end());
    return std::adjacent_find(values.begin(), values.end()) != values.end();
  };
  return !has_twins(cells) && !has_twins(tags);
}

bool GroupDirectory::receive(const pdu::GroupMap& part, std::uint32_t leader, nanoseconds now) {
  const bool fits = part.parts >= 1 && part.parts <= kMostParts && part.part < part.parts &&
                    part.groups.size() <= kPerPart * pdu::kFixedSize<pdu::CellGroup> &&
                    part.pool == pool_;
  if (!fits) {
    ++refused_;
    return false;
  }
  if (leader == leader_ && part.version < version_) return false;  // an older map that arrived late
  const bool continues =
      pending_.leader == leader && pending_.version == part.version && pending_.parts == part.parts;
  if (!continues) pending_ = {leader, part.version, part.parts, {}, {}};
  if (pending_.got[part.part]) return false;
  pending_.got[part.part] = true;
  for (const pdu::CellGroup& entry : pdu::records_of<pdu::CellGroup>(part.groups)) {
    pending_.entries.push_back(entry);
  }
  if (std::count(pending_.got.begin(), pending_.got.end(), true) != part.parts) return false;
  Pending whole = std::exchange(pending_, {});
  if (!is_sound(whole.entries)) {
    ++refused_;
    return false;
  }
  set(std::move(whole.entries), whole.version, leader, now);
  return true;
}

// Removes the rows that carry only a beacon, and gives each beacon the group of its cell.
void GroupDirectory::take_beacons(std::vector<pdu::CellGroup>& rows) {
  beacons_.clear();
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(beacons_),
               [](const pdu::CellGroup& row) { return row.beacon != 0; });
  std::erase_if(rows, [](const pdu::CellGroup& row) { return row.group == 0; });
  for (pdu::CellGroup& beacon : beacons_) {
    const auto cell = std::lower_bound(rows.begin(), rows.end(), beacon, by_cell);
    const bool has_group = cell != rows.end() && !by_cell(beacon, *cell);
    beacon.group = has_group ? cell->group : kBaseGroup.value;
  }
  std::sort(beacons_.begin(), beacons_.end(),
            [](const pdu::CellGroup& a, const pdu::CellGroup& b) { return a.beacon < b.beacon; });
}

void GroupDirectory::set(std::vector<pdu::CellGroup> entries, std::uint32_t version,
                         std::uint32_t leader, nanoseconds now) {
  const auto resting = std::partition(entries.begin(), entries.end(), std::not_fn(is_resting_row));
  resting_.assign(resting, entries.end());
  entries.erase(resting, entries.end());
  std::sort(entries.begin(), entries.end(), by_cell);
  take_beacons(entries);
  std::vector<nanoseconds> since(entries.size(), now);
  for (std::size_t i = 0; holds(now) && i < entries.size(); ++i) {
    const std::size_t before = find({entries[i].column, entries[i].row});
    const bool same = before < entries_.size() && entries_[before].group == entries[i].group;
    if (same) since[i] = since_[before];
  }
  since_ = std::move(since);
  pause_ = leader_ == 0 ? nanoseconds(0) : now - heard_;
  entries_ = std::move(entries);
  version_ = version;
  leader_ = leader;
  heard_ = now;
}

std::size_t GroupDirectory::find(CellId cell) const noexcept {
  pdu::CellGroup key;
  key.column = cell.q;
  key.row = cell.r;
  const auto found = std::lower_bound(entries_.begin(), entries_.end(), key, by_cell);
  if (found == entries_.end() || by_cell(key, *found)) return entries_.size();
  return static_cast<std::size_t>(found - entries_.begin());
}

std::optional<GroupIndex> GroupDirectory::last_group(CellId cell) const noexcept {
  const std::size_t place = find(cell);
  if (place == entries_.size()) return {};
  return GroupIndex{entries_[place].group};
}

std::optional<GroupIndex> GroupDirectory::group(CellId cell, nanoseconds now) const noexcept {
  if (!holds(now)) return {};
  return last_group(cell);
}

std::optional<GroupIndex> GroupDirectory::settled_group(CellId cell, nanoseconds settle,
                                                        nanoseconds now) const noexcept {
  const std::size_t place = find(cell);
  if (!holds(now) || place == entries_.size() || now - since_[place] < settle) return {};
  return GroupIndex{entries_[place].group};
}

std::optional<pdu::CellGroup> GroupDirectory::find_beacon(std::uint32_t tag,
                                                          nanoseconds now) const noexcept {
  if (!holds(now) || tag == 0) return {};
  const auto found = std::lower_bound(
      beacons_.begin(), beacons_.end(), tag,
      [](const pdu::CellGroup& row, std::uint32_t wanted) { return row.beacon < wanted; });
  if (found == beacons_.end() || found->beacon != tag) return {};
  return *found;
}

}  // namespace reckon::aoim
