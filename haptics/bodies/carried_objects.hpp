// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Kinematic bodies: a mover sets their motion, and pushes have no effect.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/object_mover.hpp"

namespace reckon::haptics {

/// Objects that the scene carries, and the bodies that this peer does not own. Servo thread;
/// allocates at construction only.
class CarriedObjects {
 public:
  /// @param mover may be null if nothing is carried from the start; later ones then stand
  /// @throws std::invalid_argument if something is carried and there is no mover
  CarriedObjects(const EffectPlan& plan, const BodySlots& slots,
                 std::shared_ptr<ObjectMover> mover);

  [[nodiscard]] bool empty() const noexcept { return carried_.empty(); }
  /// The numbers of the carried bodies, ascending.
  [[nodiscard]] std::span<const std::uint32_t> bodies() const noexcept { return carried_; }
  /// Carries a body, which stands at `at` until its mover moves it.
  void add(std::uint32_t body, const ObjectMotion& at) noexcept;
  /// Carries a body that its mover moves already.
  void follow(std::uint32_t body, const ObjectMotion& at) noexcept;
  /// Motion of a body by its mover, carried or not.
  [[nodiscard]] ObjectMotion motion_of(std::uint32_t body, std::chrono::nanoseconds now) noexcept;
  void remove(std::uint32_t body) noexcept { std::erase(carried_, body); }
  /// Reads their motion from the mover. @param gap [s] since the last call
  void see(std::chrono::nanoseconds now, double gap) noexcept;
  [[nodiscard]] const ObjectMotion& now(std::uint32_t body) const noexcept {
    return all_[body].now;
  }
  /// Whether a body has another pose since the last see().
  [[nodiscard]] bool is_moved(std::uint32_t body) const noexcept;
  /// Whether the new pose of a body is farther than its velocity explains, as after an outage. It
  /// strikes nothing on the way.
  [[nodiscard]] bool has_jumped(std::uint32_t body) const noexcept { return all_[body].jumps; }
  /// In the next steps they move to their present pose at constant velocity: bodies of other peers
  /// at the stated one, all others from their last pose.
  /// @param gap [s] between the two
  void drive(BodySlots& slots, double gap) const noexcept;
  /// Sets their present poses.
  void put(BodySlots& slots) const noexcept;

 private:
  struct Carried {
    std::uint32_t object = 0;
    Eigen::Vector3d origin =
        Eigen::Vector3d::Zero();  // of the shape's axes in the object's axes [m]
    bool may_jump = false;        // a body of another peer
    bool jumps = false;
    ObjectMotion before{}, now{};
  };

  std::shared_ptr<ObjectMover> mover_;
  std::vector<Carried> all_;  // by body
  std::vector<std::uint32_t> carried_;
};

}  // namespace reckon::haptics
