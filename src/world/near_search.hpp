// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which remote entities our hands could touch now, and which hands of others what moves of ours,
// without a look at all of them at each step.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/peer/world/due_column.hpp"
#include "reckon/peer/world/near_bodies.hpp"
#include "reckon/peer/world/row_column.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// A body of ours that moves without a device.
struct MovingBody {
  const deadreckon::ForceModel* model = nullptr;
  deadreckon::Pose pose;  ///< S
};

/// Which hands of others are within reach of which body, as probes. Places are shared by host, as
/// those of NearBodies.
class HandsNear {
 public:
  static constexpr std::size_t kMost = 4096;  ///< of all bodies together

  HandsNear() { found_.reserve(kMost); }
  void clear() noexcept { found_.clear(); }
  void add(std::size_t body, const deadreckon::ProbeState& hand, const Party& party,
           double depth) noexcept;
  /// To be called between the last add() and the first of().
  void sort() noexcept;
  /// Writes the hands near `body`, the first by rank as many as there is room for; returns how
  /// many.
  std::size_t of(std::size_t body, std::span<deadreckon::ProbeState> out) const noexcept;
  /// Of all bodies.
  [[nodiscard]] std::size_t size() const noexcept { return found_.size(); }

 private:
  struct Found {
    std::size_t body;
    deadreckon::ProbeState hand;
    Party party;
    double depth;              // [m]
    std::size_t of_host = 0;  // how many of its host go before it
  };
  void leave_out() noexcept;

  std::vector<Found> found_;
};

/// The search among the rows that have a force model. Each is looked at again only when it could
/// have come within reach: its distance, divided by what its model and our hands can make of it in
/// a second, tells when. Hands and bodies of ours are taken to move at kHandSpeed, and bodies to
/// turn at kBodyTurn; while they are faster, the instants come sooner, so that nothing is missed at
/// any speed.
///
/// It follows the table row by row, as a RowColumn does. One thread; allocates only at construction
/// and in expect_bodies(). A step costs about 60 ns for each entity within reach, or which an
/// update has moved, or whose instant has come: of 10,000 that are far away 3 at 500 Hz. After a
/// leap of a hand it is all of them.
class NearSearch {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr std::size_t kMostProbes = 8;
  /// [m/s], a brisk movement of an arm.
  static constexpr double kHandSpeed = 2.0;
  static constexpr double kBodyTurn = 1.0;  ///< [rad/s]
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
  /// Has what note_update(place) looks at brought near.
  void prefetch(std::size_t place) const noexcept { entry_of_.prefetch(place); }
  /// The row at this place goes, and the last row goes there.
  void erase_row(std::size_t place) noexcept;

  /// Fills `found[i]` with what is less than the reach away from `probes[i]` at `now`.
  /// @param rows those of the table now  @param probes at most kMostProbes; `found` is as long.
  void find(std::span<const RemoteEntity> rows, std::span<const deadreckon::ProbeState> probes,
            Nanoseconds now, std::span<NearBodies> found) noexcept {
    find(rows, probes, now, found, {}, no_hands_);
  }
  /// The same, and at once which rows are within the reach of `bodies`, as many as were expected at
  /// most; `hands` is cleared first.
  void find(std::span<const RemoteEntity> rows, std::span<const deadreckon::ProbeState> probes,
            Nanoseconds now, std::span<NearBodies> found, std::span<const MovingBody> bodies,
            HandsNear& hands) noexcept;
  /// So many bodies may move from now on.
  void expect_bodies(std::size_t count) { bodies_.reserve(count); }

  /// Rows that have a force model.
  [[nodiscard]] std::size_t size() const noexcept { return row_of_.size(); }
  /// Looks at a row since construction: what the search costs.
  [[nodiscard]] std::uint64_t looks() const noexcept { return looks_; }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  // What one call of find() looks for, and what it fills.
  struct Search {
    std::span<const deadreckon::ProbeState> probes;
    std::span<NearBodies> found;
    std::span<const MovingBody> bodies;
    HandsNear& hands;
    Nanoseconds now;
  };
  void look_at_due(std::span<const RemoteEntity> rows, const Search& search) noexcept;
  void advance(const Search& search) noexcept;
  [[nodiscard]] double way_of_probes(std::span<const deadreckon::ProbeState> probes) noexcept;
  [[nodiscard]] double way_of_bodies(std::span<const MovingBody> bodies) noexcept;
  [[nodiscard]] double look(const RemoteEntity& row, const Search& search) noexcept;
  [[nodiscard]] double look_from_bodies(const RemoteEntity& row, const deadreckon::Pose& pose,
                                        const Search& search) const noexcept;

  double reach_;
  RowColumn<std::uint32_t> entry_of_;  // of each row: its place in the two below, or kNone
  RowColumn<std::uint32_t> row_of_;    // of each row with a model
  DueColumn look_at_;                  // the same, when to look at it again, by hurry_
  /// Time, faster while a hand moves faster than kHandSpeed, or a body of ours than it is taken to.
  Nanoseconds hurry_{0};
  Nanoseconds last_{0};
  std::array<deadreckon::ProbeState, kMostProbes> probes_{};  // at last_
  std::size_t probe_count_ = 0;
  std::vector<MovingBody> bodies_;  // at last_
  HandsNear no_hands_;
  std::uint64_t looks_ = 0;
  double phase_ = 0;  // 0 to 1, another at each look
};

}  // namespace reckon::peer
