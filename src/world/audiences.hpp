// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recipient tiers of an entity of ours whose peers do not all receive the same updates: urgent
// tiers, one tier for each inner row of channels, and the tier of all peers (aoim::TierTable). Part
// of the model loop.
#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/seen_side.hpp"

namespace reckon::peer {

/// An update for all peers.
inline constexpr std::size_t kAllAudiences = std::numeric_limits<std::size_t>::max();

/// The recipient tiers of one entity, counted from the innermost, 0. A tier receives its own
/// updates and the updates of all outer tiers. The entity's own policy has the knowledge of the
/// innermost tier, and a SeenSide has the knowledge of each other tier. Times are seconds of one
/// steady clock. One thread; allocates at construction.
class Audiences {
 public:
  /// Time for which changes of subscription are tolerated: a new one may not be known at once, and
  /// a peer that was near does not leave at once.
  static constexpr std::chrono::nanoseconds kGrace = std::chrono::seconds(1);

  /// @param urgent number of urgent tiers, the innermost ones
  /// @param rows of the channels that are not kept, the nearest first, one tier each; empty: all
  /// are one tier  @param inmost thresholds and heartbeat of the entity
  /// @param first_repeat of visible changes [s]; it and the thresholds grow by Channel::coarser,
  /// but the repetition of an event does not
  Audiences(std::size_t urgent, std::span<const aoim::Channel> rows,
            const deadreckon::UpdatePolicy& inmost, const deadreckon::SendRule& rule,
            double first_repeat);

  /// Number of urgent tiers; the others begin at this one.
  [[nodiscard]] std::size_t urgent() const noexcept { return urgent_; }
  /// The tier of all peers.
  [[nodiscard]] std::size_t last() const noexcept { return sides_.size(); }
  /// The row of channels of a tier that is not urgent.
  [[nodiscard]] std::size_t row_of(std::size_t audience) const noexcept {
    return audience - urgent_;
  }
  [[nodiscard]] std::size_t audience_of(std::size_t row) const noexcept { return row + urgent_; }
  /// The outermost tier that receives articulated parts.
  [[nodiscard]] std::size_t receive_parts() const noexcept { return receive_parts_; }

  // Outer tiers: from 1 on.

  /// Makes the next decide() return `event` for these tiers.
  void event(std::size_t outmost) noexcept;
  [[nodiscard]] deadreckon::SendReason decide(std::size_t audience, const deadreckon::Pose& truth,
                                              double now) const noexcept {
    return sides_[audience - 1].decide(truth, now);
  }
  /// The prediction of this tier at `now`, before convergence.
  [[nodiscard]] deadreckon::Pose predicted(std::size_t audience, double now) const noexcept {
    return sides_[audience - 1].predicted(now);
  }
  /// Records an update for this tier.  @param whole whether the update is complete
  void note_sent(std::size_t audience, const deadreckon::KinematicState& as_received, double now,
                 deadreckon::SendReason reason, bool whole) noexcept;
  /// Whether inner tiers have received an update that this one has not.
  [[nodiscard]] bool is_behind(std::size_t audience) const noexcept {
    return sides_[audience - 1].is_behind();
  }
  /// Time of the last update for this tier [s].
  [[nodiscard]] double last_sent_at(std::size_t audience) const noexcept {
    return sides_[audience - 1].last_sent();
  }
  /// When decide() is due for a tier, counted from `audience` outwards, even without a change.
  [[nodiscard]] double next(std::size_t audience) const noexcept;
  /// Time of the next heartbeat to an audience >= 1 [s].
  [[nodiscard]] double heartbeat(std::size_t audience) const noexcept {
    return sides_[audience - 1].heartbeat();
  }

  // Tiers with listeners.

  /// Largest error [m] of other entities relative to their last update, if their updates are as
  /// coarse as the updates of this entity.
  [[nodiscard]] double slack() const noexcept { return slack_; }
  /// The first row with known listeners; inner rows have none.
  [[nodiscard]] std::size_t served_row() const noexcept { return served_row_; }
  /// The same as a tier: 0 if the nearest row may have listeners.
  [[nodiscard]] std::size_t served() const noexcept {
    return served_row_ == 0 ? 0 : audience_of(served_row_);
  }
  [[nodiscard]] bool has_to_look(std::chrono::nanoseconds now) const noexcept {
    return now >= look_again_;
  }
  /// Whether updates that only inner tiers got, the last at `last_sent` [s], have no known listener
  /// any more. The update is then sent once to this tier, because an unknown listener must not keep
  /// a state that the owner does not check.
  [[nodiscard]] bool is_out_of_step(std::size_t audience, double last_sent,
                                    double now) const noexcept {
    return audience > 0 && audience <= served() && is_behind(audience) &&
           now - last_sent >= pdu::to_seconds(kGrace);
  }
  void serve(std::size_t row, std::chrono::nanoseconds look_again) noexcept {
    served_row_ = row;
    look_again_ = look_again;
  }

 private:
  std::vector<SeenSide> sides_;  // of tiers 1 ..
  std::size_t urgent_;
  std::size_t receive_parts_ = 0;
  double slack_ = 0.0;
  std::size_t served_row_ = 0;
  std::chrono::nanoseconds look_again_ = std::chrono::nanoseconds::min();
};

/// Whether the receivers of a tier predict any motion from `now` [s] on. A stopped entity is at
/// rest for them only after they have received that. @param inmost the policy of the entity  @param
/// audiences null if all are one tier
[[nodiscard]] bool is_shown_moving(const deadreckon::UpdatePolicy& inmost,
                                   const Audiences* audiences, std::size_t audience,
                                   double now) noexcept;

}  // namespace reckon::peer
