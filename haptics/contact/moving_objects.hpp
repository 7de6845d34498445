// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The moving objects of a plan for one probe: present state, and state one step ago.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "reckon/haptics/contact/contact_result.hpp"
#include "reckon/haptics/queries/query_shape.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Whether an object was put elsewhere between two steps: it moved by 30 mm, or turned by 0.5 rad,
/// more than in 10 ms of its motion. Then it leaves what touched it.
[[nodiscard]] bool jumps(const ObjectMotion& now, const ObjectMotion& before) noexcept;

/// A moving object.
struct MovingObject {
  std::uint32_t object = 0;  ///< index in the plan
  PlannedObject now;
  ObjectMotion motion{}, before{};
  std::uint64_t placed = 0;                          ///< last round in which it was placed
  Eigen::Vector3d pushed = Eigen::Vector3d::Zero();  ///< force on the device before the move [N]
  QueryShape solid;                                  ///< to test for points inside
  double beyond = 0.0;  ///< [s], see ContactSolver::let_through_beyond()

  /// A fixed point of S in the object's axes one step ago. A body's shape has no origin of its own.
  [[nodiscard]] Eigen::Vector3d before_of(const Eigen::Vector3d& p_S) const noexcept {
    return before.orientation.conjugate() * (p_S - before.position);
  }
  [[nodiscard]] bool is_moved() const noexcept {
    return motion.position != before.position ||
           motion.orientation.coeffs() != before.orientation.coeffs();
  }
  /// Whether a point is outside of the solid [m, S].
  [[nodiscard]] bool is_outside(const Eigen::Vector3d& p_S) const noexcept;
};

/// A moving ball, S, and its look-ahead [s].
struct MovingProbe {
  Eigen::Vector3d place;     ///< [m]
  Eigen::Vector3d velocity;  ///< [m/s]
  double radius = 0.0;       ///< [m]
  double time = 0.0;
};

/// See the functions of the same names in ContactSolver. `contacts` has all objects.
class MovingObjects {
 public:
  explicit MovingObjects(const EffectPlan& plan);

  void place(std::uint32_t body, const ObjectMotion& motion, const ObjectMotion& before,
             std::span<const ObjectContact> contacts) noexcept;
  /// See PlannedObject::carried.
  void set_carried(std::uint32_t body, bool is_carried) noexcept {
    moving_[body].now.carried = is_carried;
  }
  /// Ends a round of place() and step(), even if the step was impossible.
  void next_round() noexcept { forget_placed(round_++); }

  /// Numbers of the objects that were placed for this round.
  [[nodiscard]] std::span<const std::uint32_t> placed() const noexcept { return placed_; }
  [[nodiscard]] MovingObject& operator[](std::uint32_t body) noexcept { return moving_[body]; }
  [[nodiscard]] const MovingObject& operator[](std::uint32_t body) const noexcept {
    return moving_[body];
  }
  /// A moving object by its index in the plan; null: static.
  [[nodiscard]] const MovingObject* moving_as(std::uint32_t index) const noexcept {
    return of_[index] != kNobody ? &moving_[of_[index]] : nullptr;
  }

  [[nodiscard]] Eigen::Vector3d velocity_of(std::uint32_t index,
                                            const Eigen::Vector3d& point) const noexcept;
  [[nodiscard]] double carried_work(std::span<const ObjectContact> contacts) const noexcept;
  [[nodiscard]] double ahead_of(std::uint32_t index) const noexcept;
  [[nodiscard]] std::optional<NearBody> near_body(
      std::size_t& next, const MovingProbe& probe,
      std::span<const ObjectContact> contacts) const noexcept;

 private:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  void forget_placed(std::uint64_t round) noexcept;

  std::vector<MovingObject> moving_;
  std::vector<std::uint32_t> placed_;
  std::vector<std::uint32_t> of_;  // per object of the plan, its number in moving_, or kNobody
  std::uint64_t round_ = 1;
};

}  // namespace reckon::haptics
