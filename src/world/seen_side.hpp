// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What those know of an entity of ours who see it but are not told what is felt of it: they hear
// the group of its cell alone, its contact group not. Part of the model loop.
#pragma once

#include <limits>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"

namespace reckon::peer {

/// The predictor that they run, beside that of those who hear all. Times are seconds of one steady
/// clock. One thread; no allocation.
class SeenSide {
 public:
  /// What only those within reach were told is told to all so much later [s] at the latest, for who
  /// went out of reach meanwhile has heard a part of it.
  static constexpr double kBehind = 0.5;

  /// @param policy nothing has been sent by
  explicit SeenSide(const deadreckon::UpdatePolicy& policy) noexcept : policy_(policy) {}

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
  /// All were told, see UpdatePolicy::sent().
  void told_all(const deadreckon::KinematicState& as_received, double now,
                deadreckon::SendReason reason) noexcept {
    policy_.sent(as_received, now, reason);
    told_ = now;
    is_behind_ = false;
  }
  /// Only those within reach were told.
  void told_those_near() noexcept { is_behind_ = true; }
  /// When decide() is due though nothing changes.
  [[nodiscard]] double next() const noexcept {
    const double next = told_ + policy_.silence();
    return next < next_in_step() ? next : next_in_step();
  }

 private:
  [[nodiscard]] double next_in_step() const noexcept {
    return is_behind_ ? told_ + kBehind : std::numeric_limits<double>::infinity();
  }

  deadreckon::UpdatePolicy policy_;
  double told_ = 0.0;
  bool is_behind_ = false;
};

}  // namespace reckon::peer
