// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/group_directory.hpp"

#include <algorithm>
#include <functional>
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

// Sorts by cell; false where a cell or a group is there twice, or the pool does not have it.
bool GroupDirectory::is_sound(std::vector<pdu::CellGroup>& entries) const {
  std::vector<bool> seen(pool_ + 1);
  for (const pdu::CellGroup& entry : entries) {
    if (entry.group < 1 || entry.group > pool_ || seen[entry.group]) return false;
    seen[entry.group] = true;
  }
  std::sort(entries.begin(), entries.end(), by_cell);
  return std::adjacent_find(entries.begin(), entries.end(),
                            [](const pdu::CellGroup& a, const pdu::CellGroup& b) {
                              return a.column == b.column && a.row == b.row;
                            }) == entries.end();
}

bool GroupDirectory::receive(const pdu::GroupMap& part, std::uint32_t leader, nanoseconds now) {
  const bool fits = part.parts >= 1 && part.parts <= kMostParts && part.part < part.parts &&
                    part.groups.size() <= kPerPart * pdu::kFixedSize<pdu::CellGroup> &&
                    part.pool == pool_;
  if (!fits) {
    ++refused_;
    return false;
  }
  if (leader == leader_ && part.version < version_) return false;  // overtaken
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

void GroupDirectory::set(std::vector<pdu::CellGroup> entries, std::uint32_t version,
                         std::uint32_t leader, nanoseconds now) {
  const auto resting = std::partition(entries.begin(), entries.end(), std::not_fn(is_resting_row));
  resting_.assign(resting, entries.end());
  entries.erase(resting, entries.end());
  std::sort(entries.begin(), entries.end(), by_cell);
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
  const auto found =
      std::find_if(entries_.begin(), entries_.end(),
                   [tag](const pdu::CellGroup& entry) { return entry.beacon == tag; });
  if (found == entries_.end()) return {};
  return *found;
}

}  // namespace reckon::aoim
