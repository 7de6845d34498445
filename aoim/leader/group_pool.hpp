// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The groups that a leader hands out to cells where there are more cells than groups. A group never
// goes from one cell to another without lying idle for the quarantine: by then nobody uses a map
// any more in which it was the former cell's.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/pdu/reckon/group_map.hpp"

namespace reckon::aoim {

/// A row of a map by which who leads no longer says that a group is in quarantine: of no cell that
/// there can be.
[[nodiscard]] constexpr pdu::CellGroup resting_row(GroupIndex group) noexcept {
  return {kWholeScene.q, group.value, 0, group.value, 0};
}
[[nodiscard]] constexpr bool is_resting_row(const pdu::CellGroup& row) noexcept {
  return row == resting_row({row.group});
}

/// One thread. @throws std::invalid_argument for a pool of 0 or above 1,000 groups.
class GroupPool {
 public:
  GroupPool(std::size_t groups, std::chrono::nanoseconds quarantine);

  /// The group of a cell, a new one where it has none: the one idle for the longest. None where all
  /// are in use or in quarantine.
  std::optional<GroupIndex> take(CellId cell, std::chrono::nanoseconds now);
  /// The cell gives its group back.
  void give_back(CellId cell, std::chrono::nanoseconds now) noexcept;
  /// A new leader begins with the map it has heard last; what is idle in it may have been handed
  /// out since, so all of that is in quarantine, unless nobody can have done so (`fresh`).
  void begin(std::span<const pdu::CellGroup> map, bool fresh, std::chrono::nanoseconds now);
  /// Another leader has handed out these: where it says the same, that stands. What is idle here
  /// goes into quarantine; of what is another cell's, both cells lose it. The same of what it says
  /// is in quarantine (see resting_row).
  void merge(std::span<const pdu::CellGroup> map, std::chrono::nanoseconds now);

  /// Calls visit(CellId, GroupIndex) for each in use.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].used) visit(slots_[i].cell, GroupIndex{static_cast<std::uint16_t>(i + 1)});
    }
  }
  /// Calls visit(GroupIndex) for each that a cell gave back within the quarantine: somebody may
  /// still use it.
  template <typename Visit>
  void for_each_resting(std::chrono::nanoseconds now, Visit&& visit) const {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const Slot& slot = slots_[i];
      const bool rests = slot.given && !slot.used && now - slot.since < quarantine_;
      if (rests) visit(GroupIndex{static_cast<std::uint16_t>(i + 1)});
    }
  }
  [[nodiscard]] std::size_t in_use() const noexcept;

 private:
  struct Slot {
    CellId cell;
    bool used = false;
    bool fresh = true;   ///< never used: no quarantine
    bool given = false;  ///< to a cell, as far as we know
    std::chrono::nanoseconds since{};
  };
  [[nodiscard]] Slot* find(CellId cell) noexcept;

  std::chrono::nanoseconds quarantine_;
  std::vector<Slot> slots_;  ///< by group - 1
};

}  // namespace reckon::aoim
