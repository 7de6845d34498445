// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which remote entities our hands could touch now, without a look at all of them at each step.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/world/due_column.hpp"
#include "reckon/peer/world/row_column.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Farther away than this between surfaces [m], a body is not worth the servo's time; nothing moves
/// so far within one update.
inline constexpr double kContactReach = 0.25;

/// A remote entity within reach of a probe, S frame.
struct NearEntity {
  const RemoteEntity* row = nullptr;                   ///< good until the next take, drop or expire
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     ///< of its model: a centre for a sphere [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the entity's origin [m/s]
  double depth = 0;  ///< [m] of the probe in it, negative outside: deadreckon::contact()
};

/// What is within reach of one probe, the nearest first.
class NearEntities {
 public:
  [[nodiscard]] std::span<const NearEntity> all() const noexcept { return {found_.data(), count_}; }
  /// Farther ones for which there was no room.
  [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }

  void clear() noexcept { count_ = left_out_ = 0; }
  void insert(const NearEntity& found) noexcept;

 private:
  std::array<NearEntity, haptics::kMaxRemoteHands> found_{};
  std::size_t count_ = 0;
  std::size_t left_out_ = 0;
};

/// The search among the rows that have a force model. Each is looked at again only when it could
/// have come within reach: its distance, divided by what its model and our hands can make of it in
/// a second, tells when. Hands are taken to move at kHandSpeed; while they move faster, the
/// instants come sooner, so that nothing is missed at any speed.
///
/// It follows the table row by row, as a RowColumn does. One thread; allocates only at
/// construction. A step costs about 60 ns for each entity within reach, or which an update has
/// moved, or whose instant has come: of 10,000 that are far away 3 at 500 Hz.
/// After a leap of a hand it is all of them.
class NearSearch {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr std::size_t kMostProbes = 8;
  /// [m/s], a brisk movement of an arm.
  static constexpr double kHandSpeed = 2.0;
  /// After half of it to all of it the farthest is looked at again, although nothing has changed:
  /// not all of them at one step.
  static constexpr Nanoseconds kHorizon = std::chrono::seconds(8);

  /// @param capacity rows of the table  @param reach [m] between surfaces, >= 0
  NearSearch(std::size_t capacity, double reach);

  /// A row without a force model was added at the end.
  void add_row() { entry_of_.push(kNone); }
  /// The row at this place has a force model from now on, or has been updated.
  void note_model(std::size_t place);
  void note_update(std::size_t place) noexcept;
  /// The row at this place goes, and the last row goes there.
  void erase_row(std::size_t place) noexcept;

  /// Fills `found[i]` with what is less than the reach away from `probes[i]` at `now`.
  /// @param rows those of the table now  @param probes at most kMostProbes; `found` is as long.
  void find(std::span<const RemoteEntity> rows, std::span<const deadreckon::ProbeState> probes,
            Nanoseconds now, std::span<NearEntities> found) noexcept;

  /// Rows that have a force model.
  [[nodiscard]] std::size_t size() const noexcept { return row_of_.size(); }
  /// Looks at a row since construction: what the search costs.
  [[nodiscard]] std::uint64_t looks() const noexcept { return looks_; }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  void advance(std::span<const deadreckon::ProbeState> probes, Nanoseconds now) noexcept;
  [[nodiscard]] double look(const RemoteEntity& row, std::span<const deadreckon::ProbeState> probes,
                            Nanoseconds now, std::span<NearEntities> found) noexcept;

  double reach_;
  RowColumn<std::uint32_t> entry_of_;  // of each row: its place in the two below, or kNone
  RowColumn<std::uint32_t> row_of_;    // of each row with a model
  DueColumn look_at_;                  // the same, when to look at it again, by hurry_
  /// Time, faster while a hand moves faster than kHandSpeed.
  Nanoseconds hurry_{0};
  Nanoseconds last_{0};
  std::array<deadreckon::ProbeState, kMostProbes> probes_{};  // at last_
  std::size_t probe_count_ = 0;
  std::uint64_t looks_ = 0;
  double phase_ = 0;  // 0 to 1, another at each look
};

}  // namespace reckon::peer
