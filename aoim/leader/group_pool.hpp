// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The groups that a leader assigns to cells when there are more cells than groups. A group stays
// unused for the quarantine before it goes to another cell. After that nobody uses a map that
// assigns it to the former cell.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/pdu/reckon/group_map.hpp"

namespace reckon::aoim {

/// A map row by which a former leader states that a group is in quarantine. Its cell cannot exist.
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

  /// The group of a cell. A cell without one gets the group that was unused for the longest. None
  /// if all are in use or in quarantine.
  std::optional<GroupIndex> take(CellId cell, std::chrono::nanoseconds now);
  /// Takes back the group of the cell.
  void give_back(CellId cell, std::chrono::nanoseconds now) noexcept;
  /// Starts as a new leader with the last map received. Its unused groups may have been assigned
  /// since, so they are in quarantine unless that is impossible (`fresh`).
  void begin(std::span<const pdu::CellGroup> map, bool fresh, std::chrono::nanoseconds now);
  /// Takes the map of another leader. Equal assignments remain. A group that is unused here goes
  /// into quarantine; a group that is assigned to two cells is taken from both. The same holds for
  /// groups that the map has in quarantine (see resting_row).
  void merge(std::span<const pdu::CellGroup> map, std::chrono::nanoseconds now);

  /// Calls visit(CellId, GroupIndex) for each group in use.
  void for_each(auto&& visit) const {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].used) visit(slots_[i].cell, GroupIndex{static_cast<std::uint16_t>(i + 1)});
    }
  }
  /// Calls visit(GroupIndex) for each group that a cell gave back within the quarantine, and that
  /// may still be in use elsewhere.
  void for_each_resting(std::chrono::nanoseconds now, auto&& visit) const {
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
    bool given = false;  ///< assigned to a cell, as far as we know
    std::chrono::nanoseconds since{};
  };
  [[nodiscard]] Slot* find(CellId cell) noexcept;

  std::chrono::nanoseconds quarantine_;
  std::vector<Slot> slots_;  ///< by group - 1
};

}  // namespace reckon::aoim
