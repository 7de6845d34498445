// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Knowledge of the peers that do not receive all updates of an entity of ours. They listen to the
// group of its cell, and perhaps to some near rows of the channels, but not to all nearer rows, or
// not to its contact group. Part of the model loop.
#pragma once

#include <limits>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"

namespace reckon::peer {

/// The predictor that these peers run, parallel to the predictor of the peers that receive all
/// updates. Times are seconds of one steady clock. One thread; no allocation.
class SeenSide {
 public:
  /// An update for the inner tiers alone is sent to all after at most this time [s], because a peer
  /// that left an inner tier meanwhile has received only a part.
  static constexpr double kBehind = 0.5;
  /// No such limit: a peer that moves to an outer row goes back to its states (HeldStates).
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// @param policy has no record of a sent update
  /// @param behind for how long these peers may lack an update of inner tiers [s], > 0
  explicit SeenSide(const deadreckon::UpdatePolicy& policy, double behind = kBehind) noexcept
      : policy_(policy), most_behind_(behind) {}

  /// Makes the next decide() return `event`.
  void event() noexcept { policy_.event(); }
  /// Reason to send the truth at `now` to all; `none` if the peers that only see the entity still
  /// predict it well enough.
  [[nodiscard]] deadreckon::SendReason decide(const deadreckon::Pose& truth,
                                              double now) const noexcept {
    const deadreckon::SendReason reason = policy_.decide(truth, now);
    const bool is_late = reason == deadreckon::SendReason::none && now >= next_in_step();
    return is_late ? deadreckon::SendReason::heartbeat : reason;
  }
  /// Records an update to these peers and the inner ones, see UpdatePolicy::sent().
  /// @param whole whether the update is complete
  void note_sent_to_all(const deadreckon::KinematicState& as_received, double now,
                        deadreckon::SendReason reason, bool whole = true) noexcept {
    policy_.sent(as_received, now, reason);
    last_sent_ = now;
    if (whole) is_behind_ = false;
  }
  /// Records an update to the inner tiers alone.
  void note_sent_to_inner() noexcept { is_behind_ = true; }
  /// Whether inner tiers have an update that these peers lack.
  [[nodiscard]] bool is_behind() const noexcept { return is_behind_; }
  /// The prediction of these peers at `now`, before their convergence.
  [[nodiscard]] deadreckon::Pose predicted(double now) const noexcept {
    return policy_.predicted(now);
  }
  /// Time of the last update to these peers [s].
  [[nodiscard]] double last_sent() const noexcept { return last_sent_; }
  /// Time of the next heartbeat [s].
  [[nodiscard]] double heartbeat() const noexcept { return last_sent_ + policy_.silence(); }
  /// When decide() is due even without a change.
  [[nodiscard]] double next() const noexcept {
    const double next = heartbeat();
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
