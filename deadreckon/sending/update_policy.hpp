// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Decides when an owner sends: at a threshold crossing of the error of its peers' prediction, which
// it computes too, after an event, or when the heartbeat is due.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::deadreckon {

/// Reason to send, strongest first; `none` = do not send.
enum class SendReason : std::uint8_t {
  none,
  first,
  event,
  position,
  orientation,
  force,
  heartbeat
};

/// One word for counters and traces.
[[nodiscard]] std::string_view name(SendReason reason) noexcept;

/// Heartbeat of every entity with a force model [s], of any kind.
inline constexpr double kHapticHeartbeat = 5.0;

/// Greatest time [s] until an event is repeated, if changes are repeated at all. A peer that missed
/// the datagram of the event does not show it until then.
inline constexpr double kEventRepeat = 0.6;

/// A peer times out after this number of heartbeats without a datagram.
inline constexpr double kTimeoutMultiplier = 2.4;

/// Seconds between Entity States of an entity without a change, by the DIS 7 defaults: 5 s for air
/// and space, munitions, radios and supplies, 55 s on and under land and sea, 60 s for life forms,
/// environment, cultural features and all entities at rest.
[[nodiscard]] double nominal_heartbeat(const pdu::EntityType& type,
                                       bool stationary = false) noexcept;

/// `nominal` varied by up to +-10 %, always the same for an entity, so that peers that started
/// together do not send together.
[[nodiscard]] double jittered_heartbeat(double nominal, const pdu::EntityId& id) noexcept;

/// For UpdatePolicy::align_heartbeats(): a step of a tenth of a heartbeat, the tolerance of IEEE
/// 1278.1, and a phase within it. All entities of a peer share the phase, which varies between
/// peers.
struct HeartbeatGrid {
  double step, phase;  ///< [s]
};
[[nodiscard]] HeartbeatGrid heartbeat_grid(double nominal,
                                           const pdu::SimulationAddress& owner) noexcept;

/// Seconds of silence after which an entity of this nominal heartbeat is removed.
[[nodiscard]] constexpr double timeout(double nominal) noexcept {
  return kTimeoutMultiplier * nominal;
}

/// The send decision for one owned entity. The owner runs the same predictor as its peers, on the
/// same numbers. Times are seconds of one steady clock of the caller. Not synchronised, no
/// allocation.
class UpdatePolicy {
 public:
  /// @param heartbeat [s] > 0, as from jittered_heartbeat
  /// @param first_heartbeat [s] > 0, silence after a change until it is repeated. Each repetition
  /// waits twice as long as the previous one, up to `heartbeat`. A lost change is thus repaired
  /// soon, at the cost of a few packets per change. Default: no such repetitions
  /// @param rule decides when a position error is too large; must outlive the policy
  /// @param event_repeat [s] > 0, replaces `first_heartbeat` after an event if it is shorter. The
  /// next repetition waits as long as after any change, so that events have no more repetitions
  UpdatePolicy(const Thresholds& thresholds, double heartbeat, double first_heartbeat,
               const SendRule& rule = kDefaultSendRule, double event_repeat = kNever) noexcept
      : thresholds_(thresholds),
        rule_(&rule),
        heartbeat_(heartbeat),
        first_heartbeat_(std::min(first_heartbeat, heartbeat)),
        event_repeat_(std::min(event_repeat, first_heartbeat_)),
        wait_(first_heartbeat_) {}
  UpdatePolicy(const Thresholds& thresholds, double heartbeat) noexcept
      : UpdatePolicy(thresholds, heartbeat, heartbeat) {}

  /// Moves the regular heartbeats, after the repetitions of a change are over: each is sent up to
  /// `step` earlier, at a multiple of `step` after `phase` [s, of the same clock]. The heartbeats
  /// of many entities then fit into few datagrams. Step 0: each at its own time.
  /// @param step [s], at most half of the heartbeat
  void align_heartbeats(double step, double phase) noexcept {
    step_ = step;
    phase_ = phase;
  }

  /// For infrequent calls of decide(): the time until its next call [s], >= 0; default 0. decide()
  /// then sends an update in advance if before the next call the acceleration ceases to be trusted
  /// and the prediction of Reckon peers differs from the standard's by more than a threshold.
  void look_again_after(double seconds) noexcept { next_look_ = seconds; }

  /// An abrupt event (collision, new surface, appearance): the next decide() returns `event`.
  void event() noexcept { event_ = true; }

  /// Whether to send at `now`. Both predictions must be within the thresholds: the prediction of
  /// Reckon peers and, for viewers of other programs, the prediction of the standard, which trusts
  /// an acceleration without limit. `truth` is the entity's actual pose, `force_error` the result
  /// of ForcePredictor::error [N], `true_force` the size of the owner's own force [N], for
  /// Thresholds::weber. Returns `none` for a truth that is not finite, which is never sent.
  [[nodiscard]] SendReason decide(const Pose& truth, double now, double force_error = 0,
                                  double true_force = 0) const noexcept;

  /// Records the sent state at `now` and its reason. The state is the one that peers will decode,
  /// rounded to the wire's floats.
  void sent(const KinematicState& as_received, double now,
            SendReason reason = SendReason::event) noexcept;

  /// The prediction of Reckon peers at `now`, extrapolate_trusted(), before their convergence.
  /// Valid after the first sent().
  [[nodiscard]] Pose predicted(double now) const noexcept;

  [[nodiscard]] const Thresholds& thresholds() const noexcept { return thresholds_; }
  [[nodiscard]] double heartbeat() const noexcept { return heartbeat_; }
  /// Silence [s] after the last sent() at which decide() returns `heartbeat`.
  [[nodiscard]] double silence() const noexcept { return has_sent_ ? wait_ : 0.0; }

  /// Step and phase [s] of align_heartbeats().
  [[nodiscard]] double step() const noexcept { return step_; }
  [[nodiscard]] double phase() const noexcept { return phase_; }

 private:
  [[nodiscard]] SendReason error_of(const Pose& seen, const Pose& truth) const noexcept;
  [[nodiscard]] SendReason error_until(double next) const noexcept;
  [[nodiscard]] double aligned(double now) const noexcept;
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  Thresholds thresholds_;
  const SendRule* rule_;
  double heartbeat_;
  double first_heartbeat_;
  double event_repeat_;
  double wait_;                  // silence until the next repetition
  double step_ = 0, phase_ = 0;  // [s], see align_heartbeats
  double next_look_ = 0;         // [s], see look_again_after
  KinematicState sent_;
  double sent_time_ = 0;
  bool has_sent_ = false;
  bool event_ = false;
};

}  // namespace reckon::deadreckon
