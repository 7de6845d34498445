// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The received state of a remote entity. While nobody looks at the entity, its orientation stays as
// received: the first look computes it.
#pragma once

#include <chrono>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// A state in S. Reading it whole is a look; reading only where it is and how it moves is not. One
/// thread: a copy for other threads is made after a look, so that their reading changes nothing.
class LazyState {
 public:
  /// After a look an entity is watched for this time from its next update on: longer than between
  /// two pictures.
  static constexpr std::chrono::nanoseconds kWatched = std::chrono::seconds(2);

  LazyState() = default;
  LazyState(const deadreckon::KinematicState& state) noexcept : state_(state) {}
  /// Replaces the state; this is no look.
  LazyState& operator=(const deadreckon::KinematicState& state) noexcept {
    state_ = state;
    frame_ = nullptr;
    return *this;
  }
  /// The same with an orientation that is computed at the next look. @param state of a model in
  /// reference axes  @param wire its orientation as sent  @param frame S; outlives this
  void put(const deadreckon::KinematicState& state, const pdu::EulerAngles& wire,
           const deadreckon::LocalFrame& frame) noexcept {
    state_ = state;
    wire_ = wire;
    frame_ = &frame;
  }

  /// The whole state: a look.
  [[nodiscard]] const deadreckon::KinematicState& operator*() const noexcept {
    if (!seen_) look();
    return state_;
  }
  [[nodiscard]] const deadreckon::KinematicState* operator->() const noexcept { return &**this; }
  /// The state without a look; its orientation may be missing.
  [[nodiscard]] const deadreckon::KinematicState& motion() const noexcept { return state_; }

  /// Whether somebody looked since the last call, or the entity is still watched. Call it once for
  /// each update.
  [[nodiscard]] bool is_watched(std::chrono::nanoseconds now) noexcept {
    if (seen_) watched_until_ = now + kWatched;
    seen_ = false;
    return now < watched_until_;
  }
  /// Forgets the looks since the last is_watched(): they were those of the update itself.
  void forget_looks() noexcept { seen_ = false; }

 private:
  void look() const noexcept;

  mutable deadreckon::KinematicState state_;
  mutable const deadreckon::LocalFrame* frame_ = nullptr;  // if the orientation is still wire_
  std::chrono::nanoseconds watched_until_{0};
  pdu::EulerAngles wire_;
  mutable bool seen_ = false;
};

}  // namespace reckon::peer
