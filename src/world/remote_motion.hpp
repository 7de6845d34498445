// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Moves the shown state of remote entities to the received states.
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

/// A state that is being taken, with its arrival and our hand at that time.
struct ReceivedState {
  const pdu::EntityState& pdu;
  const deadreckon::KinematicState& state;  ///< the same, S frame
  const Arrival& at;
  const haptics::ServoSnapshot& servo;
  /// S, if nobody watches the row: then `state` lacks its orientation, which is computed later.
  const deadreckon::LocalFrame* unturned_in = nullptr;
};

/// Parallel to the rows of a StateTable: the clock of each sender, and the history in scenes with
/// adaptive prediction. It writes a row's state and convergence, and measures the distance of each
/// update from its prediction. One thread; allocates only at construction.
class RemoteMotion {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  enum class Outcome : std::uint8_t {
    stale,   ///< older than the known state: ignored and counted
    smooth,  ///< the shown pose converges to it
    abrupt,  ///< it is shown at once: a teleport, frozen or resumed
  };

  /// References outlive this.
  RemoteMotion(const RemoteSettings& settings, const RemoteCounters& counts);

  /// Adds a row at the end.
  void add(RemoteEntity& row);
  /// Moves the last row to `place`.  @param rows without the erased one
  void erase(std::size_t place, std::span<RemoteEntity> rows) noexcept;
  /// Prefetches the memory that take() reads.
  void prefetch(std::size_t place) const noexcept { clocks_.prefetch(place); }

  /// Whether an update without a force model is taken whole. Otherwise its orientation is computed
  /// when somebody looks, and its shown pose does not converge, because nobody has seen the one
  /// before. Call it once for each update.
  [[nodiscard]] bool is_watched(RemoteEntity& row, const pdu::EntityState& pdu,
                                Nanoseconds now) const noexcept;
  /// Applies a state to the row at `place`.
  Outcome take(RemoteEntity& row, std::size_t place, const ReceivedState& heard) noexcept;
  /// Returns to a state that was received before, without a jump.
  void go_back(RemoteEntity& row, std::size_t place, const HeldState& held,
               Nanoseconds now) noexcept;
  /// The row at `place` passes to the peer with this epoch, which has another clock.
  void change_sender(RemoteEntity& row, std::size_t place, std::uint32_t epoch) noexcept {
    row.epoch = epoch;
    clocks_[place] = SenderClock();
  }
  /// For an owner that is believed again: the entity moves on from its shown place, or jumps if
  /// this place is too far from the continued prediction.
  void resume(RemoteEntity& row, Nanoseconds now) noexcept;

  /// Innovations, see RemoteEntities. Any thread.
  [[nodiscard]] const ErrorHistogram& pose_jumps() const noexcept { return pose_jumps_; }
  [[nodiscard]] const ErrorHistogram& force_jumps() const noexcept { return force_jumps_; }

 private:
  Outcome take_unwatched(RemoteEntity& row, const ReceivedState& heard, Nanoseconds time) noexcept;
  static void note_state(RemoteEntity& row, const ReceivedState& heard, Nanoseconds time) noexcept;
  /// @param expected prediction by the last update for this one's instant
  void note_history(RemoteEntity& row, std::size_t place, const deadreckon::Pose& expected,
                    bool abrupt) noexcept;
  [[nodiscard]] bool is_teleport(const deadreckon::Pose& shown,
                                 const deadreckon::Pose& expected) const noexcept;
  void note_jump(RemoteEntity& row, const Eigen::Vector3d& before,
                 const Eigen::Vector3d& after) noexcept;
  void note_force_jump(const RemoteEntity& row, const deadreckon::Pose& before,
                       const deadreckon::Pose& after, const haptics::ServoSnapshot& servo) noexcept;
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
