// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/wall_books.hpp"

#include <algorithm>

namespace reckon::haptics {

// A wall out of reach of the handle stores nothing, so it is always affordable.
SpringWall WallBooks::payable(std::size_t axis, WallSide side, const SpringWall& wanted,
                              PlaceRange places) const noexcept {
  constexpr int kHalvings = 30;
  const SpringWall& old = shown_.wall(axis, side);
  const double there = std::max(0.0, energy_);
  const auto is_paid = [&](double at) {
    return worst_rise(old, {at, wanted.stiffness, wanted.most}, side, places) <= there;
  };
  if (is_paid(wanted.at)) return wanted;
  double paid = side == WallSide::below ? places.from : places.to, unpaid = wanted.at;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (paid + unpaid);
    (is_paid(middle) ? paid : unpaid) = middle;
  }
  return {paid, wanted.stiffness, wanted.most};
}

void WallBooks::book(std::size_t axis, WallSide side, const SpringWall& wall,
                     PlaceRange places) noexcept {
  SpringWall& old = shown_.wall(axis, side);
  energy_ = std::min(kMost, energy_ - worst_rise(old, wall, side, places));
  old = wall;
}

}  // namespace reckon::haptics
