// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which bodies a hand may meet in the period that begins, so that its step looks at no others.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/haptics/queries/cell_grid.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

struct BodyState;

/// What a hand may touch: a ball about its probes, and the points that they are held at.
struct HandReach {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m], S
  double radius = 0.0;                               ///< [m]
  double speed = 0.0;                                ///< [m/s], of the fastest probe
};

/// Where to look for bodies.
struct BodiesAbout {
  std::span<const BodyState> states;     ///< of all
  std::span<const std::uint32_t> awake;  ///< that may move; one that does not may be among them
  const CellGrid& asleep;                ///< boxes of all others [m], S
};

/// One list a hand, of bodies by their numbers, ascending. It is foreseen while nobody waits, and
/// holds for as long as the hand stays where it was expected. Servo thread.
class NearBodies {
 public:
  /// A body on its way is listed so many periods before it is there.
  static constexpr double kAhead = 4.0;

  /// @param radius of the ball about each body's origin that it is in [m]; infinite: always listed
  explicit NearBodies(std::vector<double> radius);

  /// The next hand's number. Allocates.
  std::size_t add_hand();
  [[nodiscard]] std::size_t hands() const noexcept { return hands_.size(); }
  /// A hand's own, at the end of its step.
  void watch(std::size_t hand, const HandReach& reach) noexcept { hands_[hand].watched = reach; }
  /// Makes the lists of all hands. @param bodies as they will be  @param period [s]
  void foresee(const BodiesAbout& bodies, double period) noexcept;
  /// The same where no body has moved: of the hands that will soon be out of their lists.
  /// @param about returns the bodies; called where they are needed
  template <class About>
  void foresee_moved(const About& about, double period) noexcept {
    if (!is_foreseen_) return foresee(about(), period);
    for (Hand& hand : hands_) {
      if (!holds(hand, hand.watched, period, kLeft * kMargin))
        list(hand, hand.watched, about(), period);
    }
  }
  /// The states are others than those that were foreseen.
  void forget() noexcept { is_foreseen_ = false; }
  /// As foreseen, or else made now: some ns a body that is awake.
  /// @param about as above
  template <class About>
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t hand, const HandReach& reach,
                                                  const About& about, double period) noexcept {
    Hand& own = hands_[hand];
    if (!is_foreseen_ || !holds(own, reach, period, 0.0)) list(own, reach, about(), period);
    return own.bodies;
  }

 private:
  static constexpr double kMargin = 0.005;  // [m], of a hand that starts from rest
  static constexpr double kLeft = 0.5;      // of the margin, up to which a list is not made anew

  struct Hand {
    HandReach watched, at;  // at the end of its last step; where its list was made for
    double covers = 0.0;    // [m], radius about the middle within which all bodies are listed
    std::vector<std::uint32_t> bodies;
  };
  // Whether its list holds for a hand there, with room to spare [m].
  [[nodiscard]] static bool holds(const Hand& hand, const HandReach& reach, double period,
                                  double spare) noexcept {
    const double left = hand.covers - reach.radius - reach.speed * (kAhead - 1.0) * period - spare;
    return left >= 0.0 && (reach.middle - hand.at.middle).squaredNorm() <= left * left;
  }
  void list(Hand& hand, const HandReach& at, const BodiesAbout& bodies,
            double period) const noexcept;

  std::vector<double> radius_;
  std::vector<std::uint32_t> always_;  // bodies
  std::vector<Hand> hands_;
  bool is_foreseen_ = false;
};

/// Of the ball about the origin of each object of the plan that moves, for NearBodies [m].
[[nodiscard]] std::vector<double> radii_of_moving(const EffectPlan& plan);

}  // namespace reckon::haptics
