// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which entities receive which others while they move, as changes once a tick: for a program that
// observes all of them, such as a relay, the leader of a crowded cell or a study.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/bench/interest/hearing_change.hpp"
#include "reckon/bench/interest/neighbour_layout.hpp"

namespace reckon::bench {

/// Incremental interest: `observer` receives `entity` while their distance (three axes) is at most
/// the observer's radius. Exact to the rounding of the squared distance in double precision.
///
///   interest.add(7, position, 200.0); interest.move(7, next); interest.remove(7);
///   for (const HearingChange& change : interest.step()) { ... } // once a tick
///
/// All moves of a tick are applied first, then each pair that differs from the last tick is
/// reported once. No state is kept for a pair: its earlier state is computed from the positions of
/// the last tick. At each tick the entities are sorted again by position. Only pairs whose distance
/// differs from the radius by no more than both can have moved are compared. Entities that leapt,
/// came, left, or have a much greater radius than the others are compared separately. If most
/// entities leapt, all pairs are compared.
///
/// One thread; allocates nothing after one tick of each kind. Memory: below 400 octets an entity,
/// allocated as entities are added; and 28 octets a change, for as many changes as a recent tick
/// had.
class IncrementalInterest {
 public:
  /// @param capacity entities have the numbers 0 .. capacity - 1, below 2^31.
  explicit IncrementalInterest(std::size_t capacity, SimdLevel level = best_simd_level());

  /// Adds an entity with a number that is free. If the position is not finite, the entity receives
  /// nobody and is received by nobody until it moves. A radius below 0 or NaN: it receives nobody.
  /// [m, S]
  void add(std::uint32_t entity, const aoim::Position& position, double radius);
  void remove(std::uint32_t entity) noexcept;
  /// Moves an entity that is present.
  void move(std::uint32_t entity, const aoim::Position& position) noexcept;

  /// Differences from the last step, by observer and then entity. Valid until the next step.
  [[nodiscard]] std::span<const HearingChange> step();

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool holds(std::uint32_t entity) const noexcept {
    return entity < present_.size() && present_[entity].squared_radius != kAbsent;
  }
  /// Memory held now [octets].
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  static constexpr double kAbsent = -2.0;
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFFU;
  struct Sighted {
    std::uint32_t cell = kNowhere;
    Apart apart = Apart::leapt;
  };
  struct Slots {
    std::uint32_t now, before;  // one slot behind the last if the entity is absent in that layout
  };
  using Link = std::vector<std::uint32_t>;  // for each slot of one layout, the slot in the other

  void choose_reach();
  void choose_pace();
  void plan();
  [[nodiscard]] Surroundings surroundings() const;
  [[nodiscard]] Apart judge(std::uint32_t slot, const Hearer& hearer) noexcept;
  void sight(std::size_t at, const Hearer& hearer, Apart apart) noexcept;
  void sight_those_before();
  void sight_those_coming();
  void lay_out(bool most_leapt);
  void set_apart(bool most_leapt);

  void compare(const NeighbourLayout& here, const NeighbourLayout& there, const Link& link,
               ChangeTold told);
  void compare_near_edges();
  void compare_all();
  void compare_apart();
  void compare_one(const NeighbourLayout& here, std::uint32_t slot, const NeighbourLayout& there,
                   std::uint32_t slot_there, const Link& link, bool heard);

  SimdLevel level_;
  std::size_t size_ = 0;
  std::vector<Hearer> present_;       // by entity; the squared radius kAbsent marks an absent one
  std::vector<std::uint8_t> listed_;  // by entity: it is in the layout before, or arrives
  std::vector<std::uint32_t> coming_;

  NeighbourLayout now_, before_;
  Link from_, into_;                           // slots of now_ in before_; reverse if any is apart
  std::vector<Hearer> hearers_;                // entities that were present before, then arrivals
  std::vector<Sighted> sighted_;               // for the same entities
  std::vector<std::uint32_t> arrived_, gone_;  // entities; slots of before_
  std::vector<Slots> apart_;
  PairColumns pairs_;
  HearingChanges changes_;

  double reach_ = 0;              // [m], the reach of the layouts
  std::size_t came_or_went_ = 0;  // since the reach was chosen
  double pace_ = 0;               // [m] a tick: an entity that moves farther leaps
  double farthest_squared_ = 0;   // greatest squared movement of a calm entity in this tick
  std::size_t leapt_ = 0, placed_ = 0;
};

}  // namespace reckon::bench
