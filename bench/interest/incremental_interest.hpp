// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who hears whom among entities that move, told as changes once a tick: for one that keeps an eye
// on all of them, such as a relay, a leader of a crowded cell or a study.
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

/// Incremental interest: `observer` hears `entity` while their distance (three axes) is at most the
/// observer's radius. Exact to the rounding of the squared distance in double precision.
///
///   interest.add(7, position, 200.0);  interest.move(7, next);  interest.remove(7);
///   for (const HearingChange& change : interest.step()) { ... }   // once a tick
///
/// All moves of a tick are applied first, then each pair that differs from the last tick is told
/// once. Nothing is kept of a pair: it heard if it did at the places of the last tick. At each tick
/// entities are sorted anew by where they stand. Only pairs whose distance differs from the radius
/// by no more than both can have gone are compared; who leapt, came or went, or hears much farther
/// than the others, is compared by itself, and where most did, all are.
///
/// One thread; allocates nothing once it has seen a tick of each kind. Memory: below 400 octets an
/// entity, taken as they come; room for changes, 28 octets each, as many as a tick had of late.
class IncrementalInterest {
 public:
  /// @param capacity entities are named 0 .. capacity - 1, below 2^31.
  explicit IncrementalInterest(std::size_t capacity, SimdLevel level = best_simd_level());

  /// A name that is free. Where the position is not finite the entity hears and is heard by nobody
  /// until it moves; a radius below 0 or NaN counts as hearing nobody. [m, S]
  void add(std::uint32_t entity, const aoim::Position& position, double radius);
  void remove(std::uint32_t entity) noexcept;
  /// Of one that is there.
  void move(std::uint32_t entity, const aoim::Position& position) noexcept;

  /// What differs from the last step, by observer and then entity. Good until the next step.
  [[nodiscard]] std::span<const HearingChange> step();

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool holds(std::uint32_t entity) const noexcept {
    return entity < present_.size() && present_[entity].squared_radius != kAbsent;
  }
  /// Octets held now.
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  static constexpr double kAbsent = -2.0;
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFFU;
  struct Sighted {
    std::uint32_t cell = kNowhere;
    Apart apart = Apart::leapt;
  };
  struct Slots {
    std::uint32_t now, before;  // those behind the last for who is not there
  };
  using Link = std::vector<std::uint32_t>;  // slots of one layout in the other

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
  std::vector<Hearer> present_;       // by entity; squared radius kAbsent: none
  std::vector<std::uint8_t> listed_;  // by entity: in the layout before, or coming
  std::vector<std::uint32_t> coming_;

  NeighbourLayout now_, before_;
  Link from_, into_;              // slots of now_ in before_, and back where anybody is apart
  std::vector<Hearer> hearers_;   // of who was there before, then of who comes
  std::vector<Sighted> sighted_;  // of the same
  std::vector<std::uint32_t> arrived_, gone_;  // entities; slots of before_
  std::vector<Slots> apart_;
  PairColumns pairs_;
  HearingChanges changes_;

  double reach_ = 0;              // [m], of the layouts
  std::size_t came_or_went_ = 0;  // since the reach was chosen
  double pace_ = 0;               // [m] a tick: who goes farther leaps
  double farthest_squared_ = 0;   // that a calm one went this tick
  std::size_t leapt_ = 0, placed_ = 0;
};

}  // namespace reckon::bench
