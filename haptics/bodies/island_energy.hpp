// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy balance of each island of bodies in one step: work put in, and energy that the solver
// added.
#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/contact_islands.hpp"

namespace reckon::haptics {

/// Each body has an account [J], BodyKind::account. A positive account is energy that an impact has
/// dissipated, kept to lift the body out of its penetration within a step: at most its weight plus
/// the force of hands, times the depth. A negative account is energy that the solver added and the
/// body still owes. The bodies of an island pool their accounts. Each gets a share by mass times
/// depth, or by mass if none has penetrated, so no other island pays. Energy of an island beyond
/// its account and the work done on it is taken out of the velocities of its bodies; debts stay
/// until paid.
///
/// Kinetic energy + potential energy + accounts grows only by the work of the forces. Order of
/// calls within a step: begin, the others, settle. One thread; O(bodies); allocates nothing.
class IslandEnergy {
 public:
  using Islands = ContactIslands<BodySlots::kMost>;

  /// @param acting bodies of this step  @param gravity [m/s^2], S
  void begin(const BodySlots& slots, BodySet acting, const Eigen::Vector3d& gravity) noexcept;
  /// A body penetrates another, or a static object, by this depth [m].
  void sink(std::size_t slot, double depth) noexcept;
  /// A hand presses a body with this force [N].
  void press(std::size_t slot, double force) noexcept { of_[slot].pressed += force; }
  /// Work done on a body [J].
  void give(std::size_t slot, double work) noexcept { of_[slot].given += work; }
  /// A body touches a carried object. @param speed of the object at the contact, times 1 +
  /// restitution [m/s]. While its island also touches a static object, its kinetic energy is at
  /// most the energy of all its mass at this speed, or its initial energy plus the energy gained by
  /// falling.
  void drive(std::size_t slot, double speed) noexcept;
  /// A body touches a static object.
  void pin(std::size_t slot) noexcept { of_[slot].is_pinned = true; }
  /// Takes out the energy that the solver added. @return the removed energy [J]
  double settle(BodySlots& slots, Islands& islands) noexcept;

 private:
  struct Sum {
    double height = 0.0, motion = 0.0;  // [J], at the start
    double given = 0.0;                 // [J]
    double depth = 0.0;                 // [m]
    double pressed = 0.0;               // [N]
    double driven = 0.0;                // [m/s]
    bool is_pinned = false;
  };
  struct Island {
    Sum of;
    BodySet bodies = 0;
    double account = 0.0;               // [J]
    double height = 0.0, motion = 0.0;  // [J], present
    double mass = 0.0;                  // [kg]
    double sunk = 0.0;                  // [kg m]
  };
  void add(Island& island, const RigidBody& body, const Sum& sum) const noexcept;
  [[nodiscard]] double take_out(Island& island, BodySlots& slots) const noexcept;
  static void share(const Island& island, BodySlots& slots,
                    const std::array<Sum, BodySlots::kMost>& of) noexcept;

  BodySet acting_ = 0;
  Eigen::Vector3d gravity_ = Eigen::Vector3d::Zero();
  std::array<Sum, BodySlots::kMost> of_;
};

}  // namespace reckon::haptics
