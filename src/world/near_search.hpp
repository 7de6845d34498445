// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the remote entities that our hands could touch now, and the remote hands that our moving
// bodies could touch, without checking all at each step.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/peer/world/contact_beginnings.hpp"
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

/// The remote hands within reach of each moving body, as probes. If there is no room
/// for all, the hosts that they come from share the places, see NearBodies.
class HandsNear {
 public:
  static constexpr std::size_t kMost = 4096;  ///< of all bodies together

  HandsNear() { found_.reserve(kMost); }
  void clear() noexcept { found_.clear(); }
  void add(std::size_t body, const deadreckon::ProbeState& hand, const Party& party,
           double depth) noexcept;
  /// Call it between the last add() and the first of().
  void sort() noexcept;
  /// Writes the hands near `body`, best rank first, as far as there is room; returns their number.
  std::size_t of(std::size_t body, std::span<deadreckon::ProbeState> out) const noexcept;
  /// Of all bodies.
  [[nodiscard]] std::size_t size() const noexcept { return found_.size(); }

 private:
  struct Found {
    std::size_t body;
    deadreckon::ProbeState hand;
    Party party;
    double depth;             // [m]
    std::size_t of_host = 0;  // how many of the same host come before it
  };
  void leave_out() noexcept;

  std::vector<Found> found_;
};

/// The search among the rows that have a force model. A row that is out of reach is checked
/// again only when it could have come within reach: after its distance divided by the speed at
/// which its model and our hands can approach each other. Our hands and bodies are assumed to move
/// at kHandSpeed, and bodies to turn at kBodyTurn. While they are faster, checks come sooner, so
/// that nothing is missed at any speed.
///
/// Rows are added and erased together with rows of the state table, as in a RowColumn. One thread;
/// allocates only at construction and in expect_bodies(). A step costs about 60 ns for each entity
/// that is within reach, was moved by an update, or is due. Of 10,000 distant entities about 3 are
/// due in each step at 500 Hz, and after a jump of a hand all of them.
class NearSearch {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr std::size_t kMostProbes = 8;
  /// [m/s], a brisk movement of an arm.
  static constexpr double kHandSpeed = 2.0;
  static constexpr double kBodyTurn = 1.0;  ///< [rad/s]
  /// Rows that are too far away to come within reach in this time are checked again after half of
  /// it to all of it. Each row gets a different time, so that they are not all due in one step.
  static constexpr Nanoseconds kHorizon = std::chrono::seconds(8);

  /// @param capacity rows of the table  @param reach [m] between surfaces, >= 0
  NearSearch(std::size_t capacity, double reach);

  /// Marks bodies that may not press a hand yet; both outlive this.
  void mark_beginnings(ContactBeginnings& beginnings, const RowOwners& owners) noexcept {
    beginnings_ = &beginnings;
    owners_ = &owners;
  }

  /// Adds a row without a force model at the end.
  void add_row() { entry_of_.push(kNone); }
  /// The row at this place has a new force model, or was updated.
  void note_model(std::size_t place);
  void note_update(std::size_t place) noexcept;
  /// Prefetches the memory that note_update(place) reads.
  void prefetch(std::size_t place) const noexcept { entry_of_.prefetch(place); }
  /// Removes the row at this place; the last row takes its place.
  void erase_row(std::size_t place) noexcept;

  /// Fills `found[i]` with the rows closer than the reach to `probes[i]` at `now`.
  /// @param rows the present rows of the table
  /// @param probes at most kMostProbes; `found` has the same length.
  void find(std::span<const RemoteEntity> rows, std::span<const deadreckon::ProbeState> probes,
            Nanoseconds now, std::span<NearBodies> found) noexcept {
    find(rows, probes, now, found, {}, no_hands_);
  }
  /// The same, and replaces `hands` by the remote hands within reach of `bodies`. There are at most
  /// as many bodies as expect_bodies() has reserved room for.
  void find(std::span<const RemoteEntity> rows, std::span<const deadreckon::ProbeState> probes,
            Nanoseconds now, std::span<NearBodies> found, std::span<const MovingBody> bodies,
            HandsNear& hands) noexcept;
  /// Reserves room for this many moving bodies.
  void expect_bodies(std::size_t count) { bodies_.reserve(count); }

  /// Calls visit(row) for each row that has a force model. @param rows as in find()
  void visit_felt(std::span<const RemoteEntity> rows, auto&& visit) const {
    for (std::size_t i = 0; i < row_of_.size(); ++i) visit(rows[row_of_[i]]);
  }
  /// Rows that have a force model.
  [[nodiscard]] std::size_t size() const noexcept { return row_of_.size(); }
  /// Checks of rows since construction: the cost of the search.
  [[nodiscard]] std::uint64_t looks() const noexcept { return looks_; }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  // Inputs and results of one find().
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
  [[nodiscard]] double look(const RemoteEntity& row, std::size_t place,
                            const Search& search) noexcept;
  [[nodiscard]] double look_from_bodies(const RemoteEntity& row, const deadreckon::Pose& pose,
                                        const Search& search) const noexcept;

  double reach_;
  ContactBeginnings* beginnings_ = nullptr;
  const RowOwners* owners_ = nullptr;
  RowColumn<std::uint32_t> entry_of_;  // of each row: its place in the two below, or kNone
  RowColumn<std::uint32_t> row_of_;    // of each row with a model
  DueColumn look_at_;  // when to check each row with a model again, in the time of hurry_
  /// Time that runs faster while a hand or a body of ours is faster than assumed.
  Nanoseconds hurry_{0};
  Nanoseconds last_{0};
  std::array<deadreckon::ProbeState, kMostProbes> probes_{};  // at last_
  std::size_t probe_count_ = 0;
  std::vector<MovingBody> bodies_;  // at last_
  HandsNear no_hands_;
  std::uint64_t looks_ = 0;
  double phase_ = 0;  // 0 to 1, another value at each check
};

}  // namespace reckon::peer
