// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lists the bodies that a hand may touch in a period, so its step checks no others.
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

/// Reach of a hand: a ball around its probes and their contact points.
struct HandReach {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m], S
  double radius = 0.0;                               ///< [m]
  double speed = 0.0;                                ///< [m/s], speed of the fastest probe
};

/// The bodies to search.
struct BodiesAbout {
  std::span<const BodyState> states;     ///< all bodies
  std::span<const std::uint32_t> awake;  ///< bodies that may move, possibly with others
  const CellGrid& asleep;                ///< boxes of all other bodies [m], S
};

/// One list for each hand: bodies by number, ascending. Lists are made ahead, outside the critical
/// path, and stay valid while the hand is where it was expected. Servo thread.
class NearBodies {
 public:
  /// Number of periods by which a moving body is listed before it arrives.
  static constexpr double kAhead = 4.0;

  /// @param radius of a ball around each body's origin that contains it [m]; infinite: always
  /// listed
  explicit NearBodies(std::vector<double> radius);

  /// Adds a hand. @return its number. Allocates.
  std::size_t add_hand();
  [[nodiscard]] std::size_t hands() const noexcept { return hands_.size(); }
  /// Sets a hand's reach at the end of its step.
  void watch(std::size_t hand, const HandReach& reach) noexcept { hands_[hand].watched = reach; }
  /// Makes the lists of all hands. @param bodies in their next states @param period [s]
  void foresee(const BodiesAbout& bodies, double period) noexcept;
  /// The same if no body has moved: only for hands that will soon leave the range of their lists.
  /// @param about returns the bodies; called only if needed
  void foresee_moved(const auto& about, double period) noexcept {
    if (!is_foreseen_) return foresee(about(), period);
    for (Hand& hand : hands_) {
      if (!holds(hand, hand.watched, period, kLeft * kMargin))
        list(hand, hand.watched, about(), period);
    }
  }
  /// The states differ from the predicted ones.
  void forget() noexcept { is_foreseen_ = false; }
  /// The list of a hand, made now if it is not valid: some ns for each awake body.
  /// @param about as above
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t hand, const HandReach& reach,
                                                  const auto& about, double period) noexcept {
    Hand& own = hands_[hand];
    if (!is_foreseen_ || !holds(own, reach, period, 0.0)) list(own, reach, about(), period);
    return own.bodies;
  }

 private:
  static constexpr double kMargin = 0.005;  // [m], margin for a hand that starts from rest
  static constexpr double kLeft = 0.5;      // share of the margin down to which a list is kept

  struct Hand {
    HandReach watched, at;  // reach at the end of its last step, and reach of its list
    double covers = 0.0;    // [m], radius around the middle within which the list is complete
    std::vector<std::uint32_t> bodies;
  };
  // Whether the list is valid for a hand at `reach`, with `spare` [m].
  [[nodiscard]] static bool holds(const Hand& hand, const HandReach& reach, double period,
                                  double spare) noexcept {
    const double left = hand.covers - reach.radius - reach.speed * (kAhead - 1.0) * period - spare;
    return left >= 0.0 && (reach.middle - hand.at.middle).squaredNorm() <= left * left;
  }
  void list(Hand& hand, const HandReach& at, const BodiesAbout& bodies,
            double period) const noexcept;

  std::vector<double> radius_;
  std::vector<std::uint32_t> always_;  // bodies that are always listed
  std::vector<Hand> hands_;
  bool is_foreseen_ = false;
};

/// Radii of NearBodies for the moving objects of the plan [m].
[[nodiscard]] std::vector<double> radii_of_moving(const EffectPlan& plan);

}  // namespace reckon::haptics
