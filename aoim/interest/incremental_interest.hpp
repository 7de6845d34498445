// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who hears whom among entities that move, told as changes once a tick: for one that keeps an eye
// on all of them, such as a relay, a leader of a crowded cell or a study.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/aoim/interest/neighbour_layout.hpp"

namespace reckon::aoim {

/// Incremental interest: `observer` hears `entity` while their distance (three axes) is at most the
/// observer's radius. Exact to the rounding of the squared distance in double precision.
///
///   interest.add(7, position, 200.0);  interest.move(7, next);  interest.remove(7);
///   for (const HearingChange& change : interest.step()) { ... }   // once a tick
///
/// All moves of a tick are applied first, then each pair that differs from the last tick is told
/// once. Entities lie in the order of the places where they stood (NeighbourLayout), with room for
/// how far they drift meanwhile; who drifts farther, or hears much farther than the others, is
/// compared by itself. A new order is made beside the old one, a share of the work each tick.
///
/// One thread. Memory: below 400 octets an entity, taken as they come;
/// room for changes, 24 octets each, as many as any tick had: the first has all pairs.
class IncrementalInterest {
 public:
  /// @param capacity entities are named 0 .. capacity - 1, below 2^31.
  explicit IncrementalInterest(std::size_t capacity, SimdLevel level = best_simd_level());

  /// A name that is free. Where the position is not finite the entity hears and is heard by nobody
  /// until it moves; a radius below 0 or NaN counts as hearing nobody. [m, S]
  void add(std::uint32_t entity, const Position& position, double radius);
  void remove(std::uint32_t entity) noexcept;
  /// Of one that is there.
  void move(std::uint32_t entity, const Position& position);

  /// What differs from the last step, by observer and then entity. Good until the next step.
  [[nodiscard]] std::span<const HearingChange> step();

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool holds(std::uint32_t entity) const noexcept {
    return entity < places_.size() && places_[entity].slot != kAbsent;
  }
  /// Octets held now.
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  static constexpr std::uint32_t kAbsent = 0xFFFFFFFFU;
  static constexpr std::uint32_t kLoose = 0xFFFFFFFEU;
  struct Place {
    std::uint32_t slot = kAbsent;  // in layout_, or kLoose
    std::uint32_t loose = 0;       // in loose_, where so
    double radius = 0;
  };
  struct Loose {
    std::uint32_t entity;
    Position position;
  };
  struct Hearing {
    std::uint32_t observer, entity;
    friend auto operator<=>(const Hearing&, const Hearing&) = default;
  };
  enum class Making { nothing, announcing, putting };

  void loosen(std::uint32_t entity, const Position& position);
  void drop_loose(std::uint32_t entity) noexcept;
  [[nodiscard]] Position position_of(std::uint32_t entity) const noexcept;
  [[nodiscard]] bool fits(const Place& place, const Position& position, double reach) const;

  void find_loose_hearings(std::vector<Hearing>& hearings);
  void compare_loose();
  void sort_changes();

  [[nodiscard]] double typical_reach();
  void begin_making();
  void make_some(std::size_t entities);
  [[nodiscard]] std::size_t share_of_making() const;
  void take_made();
  void start_afresh();

  SimdLevel level_;
  std::vector<Place> places_;
  std::size_t size_ = 0;
  NeighbourLayout layout_, made_;
  std::vector<Loose> loose_;
  std::vector<Hearing> loose_before_, loose_now_;
  std::vector<HearingChange> changes_, sorted_;
  std::vector<std::uint32_t> first_of_;  // changes of each observer, while sorting

  Making making_ = Making::nothing;
  std::size_t made_to_ = 0;        // entities looked at, of this pass
  std::vector<Position> anchors_;  // of those announced, in their order
  std::vector<std::uint32_t> announced_;
  int age_ = 0;  // ticks since the layout in use was begun
  int made_age_ = 0;
};

}  // namespace reckon::aoim
