// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy books of a device that renders springs by itself.
#pragma once

#include <algorithm>

#include "reckon/haptics/passivity/spring_wall.hpp"

namespace reckon::haptics {

/// With a fixed model, such a device is a spring and adds no energy. A change of the model can add
/// energy, because the handle's position at that instant is unknown. So a change is booked with its
/// greatest cost at any possible position of the handle, and is not made if it costs more than is
/// available. Friction and damping of the device are not credited.
///
/// The hand never gets more energy from the device than it put in: energy() plus the energy stored
/// in the walls is at most the absorbed energy. This holds if changes reach the device in order,
/// within the time for which `places` is valid, and the device renders its model.
///
/// One thread. No allocation.
class WallBooks {
 public:
  /// Greatest energy kept [J], so that a later change cannot spend the savings of a long session.
  static constexpr double kMost = 0.02;

  /// The affordable wall nearest to `wanted`: equal to it, or deeper. With a debt, a wall that
  /// costs nothing. About 2 us.
  /// @param places possible positions of the handle until the device has the wall
  [[nodiscard]] SpringWall payable(std::size_t axis, WallSide side, const SpringWall& wanted,
                                   PlaceRange places) const noexcept {
    // A wall out of reach of the handle stores nothing, so it is always affordable.
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
  /// Books a wall that was sent to the device.
  void book(std::size_t axis, WallSide side, const SpringWall& wall, PlaceRange places) noexcept {
    SpringWall& old = shown_.wall(axis, side);
    energy_ = std::min(kMost, energy_ - worst_rise(old, wall, side, places));
    old = wall;
  }
  /// The device may have ended its effects by itself, or not: writes off the stored energy.
  void forget() noexcept { shown_ = {}; }

  /// Energy outside the walls [J]; negative if a change reached the device later than `places`
  /// covers.
  [[nodiscard]] double energy() const noexcept { return energy_; }
  [[nodiscard]] const SpringModel& shown() const noexcept { return shown_; }

 private:
  SpringModel shown_;
  double energy_ = 0.0;
};

}  // namespace reckon::haptics
