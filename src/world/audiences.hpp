// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// To whom an update of an entity of ours goes, where not all receive the same: those who hear its
// contact group, those who hear the group of a near row of channels, and all. Part of the model
// loop.
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

/// An update to everybody.
inline constexpr std::size_t kAllAudiences = std::numeric_limits<std::size_t>::max();

/// The audiences of one entity, from the inmost, 0, on. An update for an audience is heard by it
/// and by all before it. What the inmost know is the entity's own policy; what each other one
/// knows, a SeenSide. Times are seconds of one steady clock. One thread; allocates at construction.
class Audiences {
 public:
  /// Who says that it listens may not be known otherwise; nor is who was near gone at once.
  static constexpr std::chrono::nanoseconds kGrace = std::chrono::seconds(1);

  /// @param felt those who hear the contact group are the inmost  @param rows of the channels that
  /// are not kept, the nearest first, an audience each; empty: all are one
  /// @param inmost thresholds and heartbeat of the entity  @param first_repeat of what is seen [s];
  /// it and the thresholds grow by Channel::coarser, but not the repetition of an event
  Audiences(bool felt, std::span<const aoim::Channel> rows, const deadreckon::UpdatePolicy& inmost,
            const deadreckon::SendRule& rule, double first_repeat);

  [[nodiscard]] bool has_felt() const noexcept { return felt_; }
  /// The audience that is everybody.
  [[nodiscard]] std::size_t last() const noexcept { return sides_.size(); }
  /// The row of channels of an audience that is not the contact group's.
  [[nodiscard]] std::size_t row_of(std::size_t audience) const noexcept {
    return felt_ ? audience - 1 : audience;
  }
  [[nodiscard]] std::size_t audience_of(std::size_t row) const noexcept {
    return felt_ ? row + 1 : row;
  }
  /// The outmost one that receives articulated parts.
  [[nodiscard]] std::size_t receive_parts() const noexcept { return receive_parts_; }

  // Of those behind the inmost: audiences from 1 on.

  /// The next decide() of these says `event`.
  void event(std::size_t outmost) noexcept;
  [[nodiscard]] deadreckon::SendReason decide(std::size_t audience, const deadreckon::Pose& truth,
                                              double now) const noexcept {
    return sides_[audience - 1].decide(truth, now);
  }
  /// An update went to this audience. @param whole all that there is to say of it
  void note_sent(std::size_t audience, const deadreckon::KinematicState& as_received, double now,
                 deadreckon::SendReason reason, bool whole) noexcept;
  /// Whether something was sent to those before it and not to it.
  [[nodiscard]] bool is_behind(std::size_t audience) const noexcept {
    return sides_[audience - 1].is_behind();
  }
  /// When something was sent to it last [s].
  [[nodiscard]] double last_sent_at(std::size_t audience) const noexcept {
    return sides_[audience - 1].last_sent();
  }
  /// When decide() is due for one of those from `audience` on though nothing changes.
  [[nodiscard]] double next(std::size_t audience) const noexcept;

  // Whom it is of use to tell.

  /// How far off [m] others may be from where their last update put them, as far as their
  /// updates are as coarse as this entity's.
  [[nodiscard]] double slack() const noexcept { return slack_; }
  /// In the rows before this one nobody is known to listen.
  [[nodiscard]] std::size_t served_row() const noexcept { return served_row_; }
  /// The same as an audience: 0 where somebody may listen to the nearest row.
  [[nodiscard]] std::size_t served() const noexcept {
    return served_row_ == 0 ? 0 : audience_of(served_row_);
  }
  [[nodiscard]] bool has_to_look(std::chrono::nanoseconds now) const noexcept {
    return now >= look_again_;
  }
  /// Whether nobody is known any more to hear what was sent to those before this audience alone,
  /// last at `last_sent` [s]: it is sent to this one once, so that whoever does hear it knows no
  /// more than is watched.
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
  std::vector<SeenSide> sides_;  // of audiences 1 ..
  bool felt_;
  std::size_t receive_parts_ = 0;
  double slack_ = 0.0;
  std::size_t served_row_ = 0;
  std::chrono::nanoseconds look_again_ = std::chrono::nanoseconds::min();
};

}  // namespace reckon::peer
