// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How what is shown of remote entities follows the states that their owners send.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/held_states.hpp"
#include "reckon/peer/world/remote_counters.hpp"
#include "reckon/peer/world/remote_settings.hpp"
#include "reckon/peer/world/row_column.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// A state being taken, with when it came and our hand then.
struct HeardState {
  const pdu::EntityState& pdu;
  const deadreckon::KinematicState& state;  ///< the same, S frame
  const Arrival& at;
  const haptics::ServoSnapshot& servo;
};

/// Beside the rows of a StateTable: the clock of each sender, and the history in scenes of adaptive
/// prediction. It writes a row's state and its convergence, and measures how far each update was
/// from what had been predicted. One thread; allocates at construction alone.
class RemoteMotion {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  enum class Outcome : std::uint8_t {
    stale,   ///< older than what is known: nothing has changed, it is counted
    smooth,  ///< what is shown converges to it
    abrupt,  ///< it is shown at once: a teleport, frozen or resumed
  };

  /// References outlive this.
  RemoteMotion(const RemoteSettings& settings, const RemoteCounters& counts);

  /// A row was added at the end.
  void add(RemoteEntity& row);
  /// The last row has gone to `place`. @param rows without the one that was erased
  void erase(std::size_t place, std::span<RemoteEntity> rows) noexcept;
  /// Has what take() looks at brought near.
  void prefetch(std::size_t place) const noexcept { clocks_.prefetch(place); }

  /// The row at `place` takes a state.
  Outcome take(RemoteEntity& row, std::size_t place, const HeardState& heard) noexcept;
  /// It goes back to a state that was heard before, without a jump.
  void go_back(RemoteEntity& row, std::size_t place, const HeldState& held,
               Nanoseconds now) noexcept;
  /// Its owner is believed again: it goes on from where it is shown, at once where that is too far
  /// from what was predicted meanwhile.
  void resume(RemoteEntity& row, Nanoseconds now) noexcept;

  /// Innovations, see RemoteEntities. Any thread.
  [[nodiscard]] const ErrorHistogram& pose_jumps() const noexcept { return pose_jumps_; }
  [[nodiscard]] const ErrorHistogram& force_jumps() const noexcept { return force_jumps_; }

 private:
  static void note_state(RemoteEntity& row, const HeardState& heard, Nanoseconds time) noexcept;
  /// `expected`: what the update before said of this one's instant.
  void note_history(RemoteEntity& row, std::size_t place, const deadreckon::Pose& expected,
                    bool abrupt) noexcept;
  [[nodiscard]] bool is_teleport(const deadreckon::Pose& shown,
                                 const deadreckon::Pose& expected) const noexcept;
  void note_jump(RemoteEntity& row, const deadreckon::Pose& before, const deadreckon::Pose& after,
                 const haptics::ServoSnapshot& servo) noexcept;
  void snap(RemoteEntity& row) noexcept;

  const RemoteSettings& settings_;
  const RemoteCounters& counts_;
  const bool is_adaptive_;
  RowColumn<SenderClock> clocks_;                // from their timestamps to our time
  RowColumn<deadreckon::AdaptiveOrder> orders_;  // in scenes of adaptive prediction
  ErrorHistogram pose_jumps_;
  ErrorHistogram force_jumps_;
};

}  // namespace reckon::peer
