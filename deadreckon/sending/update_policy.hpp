// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When an owner has to send: the prediction of its peers, which it repeats, is off by more than a
// threshold, an event occurred, or the heartbeat is due.
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
/// its datagram does not see it until then.
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

/// For UpdatePolicy::align_heartbeats(): a tenth of a heartbeat, the tolerance of IEEE 1278.1, and
/// a moment within it that the entities of a peer share and other peers' do not.
struct HeartbeatGrid {
  double step, phase;  ///< [s]
};
[[nodiscard]] HeartbeatGrid heartbeat_grid(double nominal,
                                           const pdu::SimulationAddress& owner) noexcept;

/// Seconds of silence after which an entity of this nominal heartbeat is removed.
[[nodiscard]] constexpr double timeout(double nominal) noexcept {
  return kTimeoutMultiplier * nominal;
}

/// The decision for one owned entity. The owner runs the predictor of its peers from the same
/// numbers. Times are seconds of one steady clock of the caller. Not synchronised, no allocation.
class UpdatePolicy {
 public:
  /// @param heartbeat [s] > 0, as from jittered_heartbeat
  /// @param first_heartbeat [s] > 0, silence after a change until it is repeated. Each repetition
  /// waits twice as long as the one before, up to `heartbeat`. So a lost change is repaired soon,
  /// for a few packets per change. Default: no such repetitions
  /// @param rule decides when a position is off too far; outlives the policy
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

  /// Times of regular heartbeats, once the repetitions after a change are over: each is earlier by
  /// up to `step` than it would be, at a multiple of `step` after `phase` [s, of the same clock].
  /// So the heartbeats of many entities fit into few datagrams. 0: each at its own time.
  /// @param step [s], at most half of the heartbeat
  void align_heartbeats(double step, double phase) noexcept {
    step_ = step;
    phase_ = phase;
  }

  /// Where decide() is called seldom: the time until its next call [s], >= 0; default 0. It then
  /// sends before an acceleration ceases to be trusted, if the prediction of Reckon peers would
  /// have left the standard's by a threshold until then.
  void look_again_after(double seconds) noexcept { next_look_ = seconds; }

  /// An abrupt event (collision, new surface, appearance): the next decide() returns it.
  void event() noexcept { event_ = true; }

  /// Whether to send at `now`. Both predictions have to be within the thresholds: that of Reckon
  /// peers and, for viewers of other programs, that of the standard without a limit. `truth` is the
  /// entity's actual pose, `force_error` the result of ForcePredictor::error [N], `true_force` the
  /// size of the owner's own force [N], for Thresholds::weber. A truth that is not finite is never
  /// sent: `none`.
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
