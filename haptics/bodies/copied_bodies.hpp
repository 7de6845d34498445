// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies of other peers that are simulated here too, at hands of this peer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/carried_objects.hpp"

namespace reckon::haptics {

/// A copy is pushed like an owned body, and drawn to its owner's poses: its distance to them decays
/// with the time constant kLeast + kDelays x their delay. The draw changes its pose and no
/// velocity, because the same hands push both. Copies that touch share one correction, the mean of
/// their offsets; each has one of its own for what deviates by more than 1 mm. Servo thread;
/// allocates at construction only.
class CopiedBodies {
 public:
  static constexpr double kDelays = 4.0;
  static constexpr double kLeast = 0.08;  ///< [s], time constant of the draw without a delay
  /// Farther from the owner's pose than this [m], the copy is put there, with the owner's velocity.
  static constexpr double kFarthest = 0.05;

  /// Both outlive this.
  CopiedBodies(BodySlots& slots, CarriedObjects& carried);

  [[nodiscard]] bool empty() const noexcept { return copies_.empty(); }
  [[nodiscard]] bool contains(std::uint32_t body) const noexcept;
  /// Whether a copy is within kFarthest of its owner's pose.
  [[nodiscard]] static bool is_near(const ObjectMotion& copy, const ObjectMotion& owner) noexcept {
    return (owner.position - copy.position).norm() <= kFarthest;
  }
  /// Whether it follows its owner's poses.
  [[nodiscard]] bool is_drawn(std::uint32_t body) const noexcept;
  /// @param delay of the owner's poses [s]; infinite: they are not followed
  void add(std::uint32_t body, double delay) noexcept;
  void remove(std::uint32_t body) noexcept;
  /// Moves the copies towards their owners' poses of `now`. @param gap [s] since the last call
  void draw(std::chrono::nanoseconds now, double gap) noexcept;
  /// Calls visit(body, way [m], turn [rad]) for each copy, with its motion in the last draw().
  void each_drawn(auto&& visit) const {
    for (const Copy& copy : copies_) visit(copy.body, copy.way, copy.turn);
  }

 private:
  struct Copy {
    std::uint32_t body = 0;
    double time = kLeast;  // [s], of the draw
    Eigen::Vector3d way = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  };

  BodySlots& slots_;
  CarriedObjects& carried_;
  std::vector<Copy> copies_;
};

}  // namespace reckon::haptics
