// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/held_states.hpp"

#include <algorithm>

#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {

HeldStates::HeldStates(std::size_t near_rows, std::size_t capacity)
    : shown_by_(near_rows > 0 ? capacity : 0) {
  behind_.reserve(near_rows);
  for (std::size_t row = 0; row < near_rows; ++row) behind_.emplace_back(capacity);
}

void HeldStates::push() {
  if (!is_on()) return;
  for (RowColumn<HeldState>& column : behind_) column.push();
  shown_by_.push();
}

void HeldStates::erase(std::size_t place) noexcept {
  if (!is_on()) return;
  for (RowColumn<HeldState>& column : behind_) column.erase(place);
  shown_by_.erase(place);
}

void HeldStates::note(std::size_t place, std::size_t row, const HeldState& heard,
                      bool newest) noexcept {
  for (std::size_t nearer = 0; nearer < std::min(row, behind_.size()); ++nearer) {
    HeldState& held = behind_[nearer][place];
    const bool is_older =
        held.is_heard && pdu::difference_units(heard.timestamp, held.timestamp) < 0;
    if (!is_older) held = heard;
  }
  if (newest) shown_by_[place] = heard.group;
}

}  // namespace reckon::peer
