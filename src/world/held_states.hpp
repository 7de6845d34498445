// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What was said of remote entities in the rows of channels behind the nearest that we listen to:
// who goes away from an entity goes back to what its owner knows those have heard who are farther.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/peer/world/row_column.hpp"

namespace reckon::peer {

/// A state, as it was heard.
struct HeldState {
  deadreckon::KinematicState state;  ///< S frame, at time
  std::chrono::nanoseconds time{0};  ///< our steady time
  std::uint32_t timestamp = 0;       ///< as sent
  aoim::GroupIndex group;            ///< near group that it came by; the base group: none
  bool is_heard = false;
};

/// Beside the rows of a StateTable, 200 octets an entity and near row, touched as entities come; no
/// octet where there are no near groups. One thread; allocates at construction alone.
class HeldStates {
 public:
  /// @param near_rows of the channels  @param capacity most entities
  HeldStates(std::size_t near_rows, std::size_t capacity);

  [[nodiscard]] bool is_on() const noexcept { return !behind_.empty(); }
  void push();
  void erase(std::size_t place) noexcept;

  /// Something was said by a group of this row, near_rows for that of the cell, whether or not it
  /// is the newest. @param newest it is, so it is what is shown
  void note(std::size_t place, std::size_t row, const HeldState& heard, bool newest) noexcept;

  /// Calls visit(place, HeldState) for each entity that is shown by what came by this near group,
  /// and goes back to the newest that came by a row behind it; where nothing did, it stays.
  template <typename Visit>
  void leave(aoim::GroupIndex group, std::size_t row, Visit&& visit) {
    for (std::size_t place = 0; place < shown_by_.size(); ++place) {
      if (shown_by_[place] != group) continue;
      const HeldState& held = behind_[row][place];
      if (!held.is_heard) continue;
      shown_by_[place] = held.group;
      visit(place, held);
    }
  }
  /// The near group that what is shown came by; the base group: none.
  [[nodiscard]] aoim::GroupIndex shown_by(std::size_t place) const noexcept {
    return shown_by_[place];
  }
  /// The newest that came by a row behind this one; not heard where nothing did.
  [[nodiscard]] const HeldState& behind(std::size_t place, std::size_t row) const noexcept {
    return behind_[row][place];
  }

 private:
  std::vector<RowColumn<HeldState>> behind_;  // by near row: the newest by a row behind it
  RowColumn<aoim::GroupIndex> shown_by_;      // near group of what is shown; the base group: none
};

}  // namespace reckon::peer
