// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy books of a device that renders springs by itself.
#pragma once

#include "reckon/haptics/passivity/spring_wall.hpp"

namespace reckon::haptics {

/// Between two models such a device is a spring: it makes no energy, whenever it is read. What can
/// make some is a change of the model, for nobody knows where the handle is at that instant. So a
/// change is booked with the most that it can cost at any place where the handle may be, and one
/// that costs more than is there is not made. Friction and damping of the device are not credited.
///
/// The hand never gets more out of the device than it put in: energy() + what the shown walls store
/// is at most what was absorbed. It holds while changes reach the device in their order, within the
/// time for which `places` answers, and while the device renders what it was told.
///
/// One thread. No allocation.
class WallBooks {
 public:
  /// [J]: more is not kept, lest a later change draw on all that a long session put by.
  static constexpr double kMost = 0.02;

  /// The nearest wall to `wanted` that can be paid for: as wanted, or it begins deeper. Where more
  /// is owed than is there, what costs nothing. About 2 us.
  /// @param places where the handle may be until the device has it
  [[nodiscard]] SpringWall payable(std::size_t axis, WallSide side, const SpringWall& wanted,
                                   PlaceRange places) const noexcept;
  /// The device was told this wall.
  void book(std::size_t axis, WallSide side, const SpringWall& told, PlaceRange places) noexcept;
  /// The device may have let go by itself, or may not have: what it stores is written off.
  void forget() noexcept { shown_ = {}; }

  /// [J], in no wall; below 0 where a change reached the device later than its places answer for.
  [[nodiscard]] double energy() const noexcept { return energy_; }
  [[nodiscard]] const SpringModel& shown() const noexcept { return shown_; }

 private:
  SpringModel shown_;
  double energy_ = 0.0;
};

}  // namespace reckon::haptics
