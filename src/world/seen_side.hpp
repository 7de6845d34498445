// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What those know of an entity of ours who do not receive all of it: they hear the group of its
// cell, and perhaps those of some near rows of the channels, but not all those of nearer rows, or
// not its contact group. Part of the model loop.
#pragma once

#include <limits>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"

namespace reckon::peer {

/// The predictor that they run, beside that of those who hear all. Times are seconds of one steady
/// clock. One thread; no allocation.
class SeenSide {
 public:
  /// What was sent only to those within reach is sent to all so much later [s] at the latest, for
  /// who went out of reach meanwhile has heard a part of it.
  static constexpr double kBehind = 0.5;
  /// No such haste: who goes to a row behind goes back to what was sent there (HeldStates).
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// @param policy nothing has been sent by  @param behind for how long it may lack what those
  /// nearer know [s], > 0
  explicit SeenSide(const deadreckon::UpdatePolicy& policy, double behind = kBehind) noexcept
      : policy_(policy), most_behind_(behind) {}

  /// The next decide() says `event`.
  void event() noexcept { policy_.event(); }
  /// Why to tell all what is true at `now`; `none` where those who only see it still predict it
  /// well enough.
  [[nodiscard]] deadreckon::SendReason decide(const deadreckon::Pose& truth,
                                              double now) const noexcept {
    const deadreckon::SendReason reason = policy_.decide(truth, now);
    const bool is_late = reason == deadreckon::SendReason::none && now >= next_in_step();
    return is_late ? deadreckon::SendReason::heartbeat : reason;
  }
  /// It was sent to them, as to those nearer, see UpdatePolicy::sent(). @param whole all that there
  /// is to say of it
  void told_all(const deadreckon::KinematicState& as_received, double now,
                deadreckon::SendReason reason, bool whole = true) noexcept {
    policy_.sent(as_received, now, reason);
    last_sent_ = now;
    if (whole) is_behind_ = false;
  }
  /// It was sent to those nearer alone.
  void told_those_near() noexcept { is_behind_ = true; }
  /// Whether something was sent to those nearer and not to them.
  [[nodiscard]] bool is_behind() const noexcept { return is_behind_; }
  /// When something was sent to them last [s].
  [[nodiscard]] double last_sent() const noexcept { return last_sent_; }
  /// When decide() is due though nothing changes.
  [[nodiscard]] double next() const noexcept {
    const double next = last_sent_ + policy_.silence();
    return next < next_in_step() ? next : next_in_step();
  }

 private:
  [[nodiscard]] double next_in_step() const noexcept {
    return is_behind_ ? last_sent_ + most_behind_ : kNever;
  }

  deadreckon::UpdatePolicy policy_;
  double most_behind_;
  double last_sent_ = -1e9;  // long ago
  bool is_behind_ = false;
};

}  // namespace reckon::peer
