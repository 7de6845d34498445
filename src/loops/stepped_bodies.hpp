// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies of a peer without a hand: its model loop steps them.
#pragma once

#include <chrono>

#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::peer {

/// Steps a world in periods of passed-in time. While no owned body is awake and nothing comes near
/// one, it steps nothing, and no time is made up for. Thread of the model loop; no allocation.
class SteppedBodies {
 public:
  static constexpr std::chrono::milliseconds kPeriod{1};
  static constexpr std::chrono::milliseconds kLongestGap{100};  ///< longer ones pass without motion

  /// @param world outlives this; no servo steps it
  explicit SteppedBodies(haptics::BodyWorld& world) : world_(world) {}

  /// Moves the bodies to the last full period up to `now`. @param frozen the simulation is frozen
  void step(std::chrono::nanoseconds now, bool frozen) noexcept {
    if (time_ == kNever) return pass_until(now);
    if (now - time_ < kPeriod) return;
    const bool is_pressed = world_.has_guest_pending();
    if (!moves_ && !is_pressed && !world_.has_orders() && !world_.is_mixed()) return;
    if (!moves_) pass_until(now - kPeriod);
    if (now - time_ > kLongestGap) pass_until(now - kLongestGap);
    while (now - time_ >= kPeriod) world_.advance_to(time_ += kPeriod, frozen);
    moves_ = world_.is_any_moving() || is_pressed;
  }
  /// When step() is due; never: max().
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept {
    const bool is_due = moves_ || world_.has_orders();
    if (time_ == kNever) return std::chrono::nanoseconds(0);
    return is_due ? time_ + kPeriod : std::chrono::nanoseconds::max();
  }

 private:
  static constexpr std::chrono::nanoseconds kNever = std::chrono::nanoseconds::min();

  // Orders take effect there, and the bodies begin to move in the next period.
  void pass_until(std::chrono::nanoseconds time) noexcept { world_.advance_to(time_ = time, true); }

  haptics::BodyWorld& world_;
  std::chrono::nanoseconds time_ = kNever;
  bool moves_ = true;
};

}  // namespace reckon::peer
