// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// States of remote entities that arrived in outer rows of channels. When we move away from an
// entity, we return to the state that its owner assumes for outer listeners.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/world/row_column.hpp"

namespace reckon::peer {

/// A state as received.
struct HeldState {
  deadreckon::KinematicState state;  ///< S frame, at time
  std::chrono::nanoseconds time{0};  ///< our steady time
  std::uint32_t timestamp = 0;       ///< as sent
  aoim::GroupIndex group;            ///< near group in which it arrived; the base group: none
  bool is_heard = false;
};

/// Parallel to the rows of a StateTable: 200 octets for each entity and near row, touched as
/// entities come; nothing without near groups. One thread; allocates only at construction.
class HeldStates {
 public:
  /// @param near_rows of the channels  @param capacity most entities
  HeldStates(std::size_t near_rows, std::size_t capacity)
      : shown_by_(near_rows > 0 ? capacity : 0) {
    behind_.reserve(near_rows);
    for (std::size_t row = 0; row < near_rows; ++row) behind_.emplace_back(capacity);
  }

  [[nodiscard]] bool is_on() const noexcept { return !behind_.empty(); }
  void push() {
    if (!is_on()) return;
    for (RowColumn<HeldState>& column : behind_) column.push();
    shown_by_.push();
  }
  void erase(std::size_t place) noexcept {
    if (!is_on()) return;
    for (RowColumn<HeldState>& column : behind_) column.erase(place);
    shown_by_.erase(place);
  }

  /// Forgets the states of the entity at `place`, whose next states have another sender.
  void forget(std::size_t place) noexcept {
    if (!is_on()) return;
    for (RowColumn<HeldState>& column : behind_) column[place] = {};
    shown_by_[place] = aoim::kBaseGroup;
  }

  /// Records a state from a group of this row, or of the cell for near_rows, even if it is not the
  /// newest.  @param newest whether it is the newest, so that it is shown
  void note(std::size_t place, std::size_t row, const HeldState& heard, bool newest) noexcept {
    for (std::size_t nearer = 0; nearer < std::min(row, behind_.size()); ++nearer) {
      HeldState& held = behind_[nearer][place];
      const bool is_older =
          held.is_heard && pdu::difference_units(heard.timestamp, held.timestamp) < 0;
      if (!is_older) held = heard;
    }
    if (newest) shown_by_[place] = heard.group;
  }

  /// Calls visit(place, HeldState) for each entity whose shown state came in this near group, with
  /// the newest state of an outer row to return to. An entity without such a state stays unchanged.
  void leave(aoim::GroupIndex group, std::size_t row, auto&& visit) {
    for (std::size_t place = 0; place < shown_by_.size(); ++place) {
      if (shown_by_[place] != group) continue;
      const HeldState& held = behind_[row][place];
      if (!held.is_heard) continue;
      shown_by_[place] = held.group;
      visit(place, held);
    }
  }
  /// The near group of the shown state; the base group: none.
  [[nodiscard]] aoim::GroupIndex shown_by(std::size_t place) const noexcept {
    return shown_by_[place];
  }
  /// The newest state of rows outside this one; without a reception time if there is none.
  [[nodiscard]] const HeldState& behind(std::size_t place, std::size_t row) const noexcept {
    return behind_[row][place];
  }

 private:
  std::vector<RowColumn<HeldState>> behind_;  // by near row: the newest of an outer row
  RowColumn<aoim::GroupIndex> shown_by_;      // near group of the shown state; the base group: none
};

}  // namespace reckon::peer
