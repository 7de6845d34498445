// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Is an observer aware of an entity? Class, aura, focus and nimbus, and occlusion in one evaluator,
// the cheapest question first. Per pair and not symmetric: A may be aware of B and not B of A. The
// spatial model of DIVE and MASSIVE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/cells/position.hpp"

namespace reckon::aoim {

/// What an observer attends to.
struct AwarenessFocus {
  enum class Shape : std::uint8_t {
    ball,  ///< all around
    cone,  ///< the part of the ball within `half_angle` of `axis`, such as a field of view
    box,   ///< along the axes of S, `half_sides` to each side; `radius` does not count
  };
  Shape shape = Shape::ball;
  Position position;             ///< [m, S]
  double radius = 0.0;           ///< [m], >= 0
  Position axis{1.0, 0.0, 0.0};  ///< of a cone, unit length
  double half_angle = 0.0;       ///< of a cone [rad], 0 .. pi
  Position half_sides;           ///< of a box [m], >= 0
};

/// Distance from a point to a focus [m]: 0 inside, NaN where an input is. Exact for each shape.
[[nodiscard]] double distance_to(const AwarenessFocus& focus, const Position& point) noexcept;

/// One who attends.
struct Observer {
  AwarenessFocus focus;
  /// Beyond it from `focus.position` it meets nobody, whatever the foci [m]; default no bound.
  double aura = std::numeric_limits<double>::infinity();
  std::uint32_t kinds = 0xFFFFFFFFU;  ///< bit k: entities of IEEE 1278.1 kind k, 0 .. 31, wanted
  std::uint32_t roles = 0xFFFFFFFFU;  ///< bits of which an entity must have one
};

/// One who may be noticed.
struct Subject {
  Position position;    ///< [m, S]
  double nimbus = 0.0;  ///< how far beyond itself it makes itself felt [m], >= 0
  double aura = std::numeric_limits<double>::infinity();  ///< [m]
  std::uint32_t roles = 0xFFFFFFFFU;
  std::uint8_t kind = 0;  ///< of 32 and above: wanted by all
};

/// Solid boxes along the axes of S that hide what is behind them.
class Occluders {
 public:
  struct Box {
    Position lower, upper;  ///< [m, S]
  };
  /// @throws std::invalid_argument for a box that is empty or not finite.
  explicit Occluders(std::vector<Box> boxes = {});

  /// Whether the straight line between two points passes through the inside of a box in which
  /// neither lies: who stands in a box, or a box that is touched from outside, hides nothing.
  /// Cost: about 5 ns a box.
  [[nodiscard]] bool hides(const Position& from, const Position& to) const noexcept;
  [[nodiscard]] std::span<const Box> boxes() const noexcept { return boxes_; }

 private:
  std::vector<Box> boxes_;
};

/// Answers, in the order in which they are looked for.
enum class Awareness : std::uint8_t {
  aware,
  not_finite,    ///< a position, radius or nimbus is NaN or infinite
  class_off,     ///< its kind is not wanted, or none of its roles
  auras_apart,   ///< so far away that nothing else is asked
  out_of_focus,  ///< its nimbus does not meet the focus
  occluded,      ///< something solid is between
};
inline constexpr std::size_t kAwarenessAnswers = 6;

/// The evaluator. One thread; allocates nothing.
class AwarenessEvaluator {
 public:
  /// @param occluders outlive it; null: nothing is hidden.
  explicit AwarenessEvaluator(const Occluders* occluders = nullptr) : occluders_(occluders) {}

  /// Counts by answer. About 10 ns, and the occluders where all else has passed.
  Awareness evaluate(const Observer& observer, const Subject& subject) noexcept;

  /// Pairs by answer since the start: what each stage dropped.
  [[nodiscard]] std::uint64_t count(Awareness answer) const noexcept {
    return counts_[static_cast<std::size_t>(answer)];
  }

 private:
  [[nodiscard]] Awareness answer(const Observer& observer, const Subject& subject) const noexcept;

  const Occluders* occluders_;
  std::array<std::uint64_t, kAwarenessAnswers> counts_{};
};

}  // namespace reckon::aoim
