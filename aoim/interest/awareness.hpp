// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Is an observer aware of an entity? One evaluator tests class, aura, focus and nimbus, and
// occlusion, the cheapest test first. The answer is not symmetric: A may be aware of B while B is
// not aware of A. This is the spatial model of DIVE and MASSIVE.
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
    box,   ///< along the axes of S, `half_sides` to each side; `radius` is ignored
  };
  Shape shape = Shape::ball;
  Position position;             ///< [m, S]
  double radius = 0.0;           ///< [m], >= 0
  Position axis{1.0, 0.0, 0.0};  ///< of a cone, unit length
  double half_angle = 0.0;       ///< of a cone [rad], 0 .. pi
  Position half_sides;           ///< of a box [m], >= 0
};

/// Distance from a point to a focus [m]: 0 inside, NaN if an input is NaN. Exact for each shape.
[[nodiscard]] double distance_to(const AwarenessFocus& focus, const Position& point) noexcept;

/// The participant that observes.
struct Observer {
  AwarenessFocus focus;
  /// Radius of the aura around `focus.position` [m]. Where two auras do not meet, there is no
  /// awareness, whatever the focus. Default: unbounded.
  double aura = std::numeric_limits<double>::infinity();
  std::uint32_t kinds =
      0xFFFFFFFFU;  ///< bit k: subscribes to entities of IEEE 1278.1 kind k, 0 .. 31
  std::uint32_t roles = 0xFFFFFFFFU;  ///< an entity must share one of these bits
};

/// The entity that may be observed.
struct Subject {
  Position position;    ///< [m, S]
  double nimbus = 0.0;  ///< radius in which it can be observed [m], >= 0
  double aura = std::numeric_limits<double>::infinity();  ///< radius [m]
  std::uint32_t roles = 0xFFFFFFFFU;
  std::uint8_t kind = 0;  ///< IEEE 1278.1; every observer subscribes to kinds 32 and above
};

/// Solid boxes along the axes of S that hide what is behind them.
class Occluders {
 public:
  struct Box {
    Position lower, upper;  ///< [m, S]
  };
  /// @throws std::invalid_argument for a box that is empty or not finite.
  explicit Occluders(std::vector<Box> boxes = {});

  /// Whether the straight line between two points passes through the interior of a box. A box that
  /// contains one of the points hides nothing, nor does a box that the line only touches. About 5
  /// ns for each box.
  [[nodiscard]] bool hides(const Position& from, const Position& to) const noexcept;
  [[nodiscard]] std::span<const Box> boxes() const noexcept { return boxes_; }

 private:
  std::vector<Box> boxes_;
};

/// Answers, in the order of the tests.
enum class Awareness : std::uint8_t {
  aware,
  not_finite,    ///< a position, radius or nimbus is NaN or infinite
  class_off,     ///< its kind is not wanted, or no role is shared
  auras_apart,   ///< the auras do not meet
  out_of_focus,  ///< its nimbus does not meet the focus
  occluded,      ///< a box is in the line of sight
};
inline constexpr std::size_t kAwarenessAnswers = 6;

/// The evaluator. One thread; allocates nothing.
class AwarenessEvaluator {
 public:
  /// @param occluders must outlive the evaluator; null: nothing is hidden.
  explicit AwarenessEvaluator(const Occluders* occluders = nullptr) : occluders_(occluders) {}

  /// Evaluates one pair and counts its answer. About 10 ns, plus the cost of the occluders if all
  /// other tests pass.
  Awareness evaluate(const Observer& observer, const Subject& subject) noexcept;

  /// Pairs with this answer since construction.
  [[nodiscard]] std::uint64_t count(Awareness answer) const noexcept {
    return counts_[static_cast<std::size_t>(answer)];
  }

 private:
  [[nodiscard]] Awareness answer(const Observer& observer, const Subject& subject) const noexcept;

  const Occluders* occluders_;
  std::array<std::uint64_t, kAwarenessAnswers> counts_{};
};

}  // namespace reckon::aoim
