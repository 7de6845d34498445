// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The energy of bodies in one step, by the islands of bodies that touch: what was put in, and what
// the solver made beyond it.
#pragma once

#include <Eigen/Core>
#include <array>

#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/contact_islands.hpp"

namespace reckon::haptics {

/// Each body has an account [J], BodyKind::account. Above zero it is energy that an impact has
/// dissipated, kept to lift the body out of what it sank into within a step: at most its weight,
/// and the hands that press, times the depth. Below zero it is energy that the solver made and the
/// body still owes. The bodies of an island pool their accounts, and each takes a share by mass
/// times depth, or by mass where none has sunk, so that no other island pays. What an island has
/// beyond its account and the work done on it is taken out of the speeds of its bodies; a debt is
/// never forgiven.
///
/// Kinetic energy + weight + accounts grows by the work of the forces alone. Order of calls within
/// a step: begin, the others, settle. One thread; O(bodies); allocates nothing.
class IslandEnergy {
 public:
  using Islands = ContactIslands<BodySlots::kMost>;

  /// @param acting bodies of this step  @param gravity [m/s^2], S
  void begin(const BodySlots& slots, BodySet acting, const Eigen::Vector3d& gravity) noexcept;
  /// A body is this deep [m] in another, or in what stands still.
  void sink(std::size_t slot, double depth) noexcept;
  /// A hand presses it with this force [N].
  void press(std::size_t slot, double force) noexcept { of_[slot].pressed += force; }
  /// Work done on it [J].
  void give(std::size_t slot, double work) noexcept { of_[slot].given += work; }
  /// It touches a carried object that moves at this speed there [m/s], times 1 + restitution. While
  /// its island also touches what stands still, its kinetic energy is at most that of all its mass
  /// at this speed, or what it had at the begin and gained by falling.
  void drive(std::size_t slot, double speed) noexcept;
  /// It touches what stands still.
  void pin(std::size_t slot) noexcept { of_[slot].is_pinned = true; }
  /// Takes out what the solver made. @return how much [J]
  double settle(BodySlots& slots, Islands& islands) noexcept;

 private:
  struct Sum {
    double height = 0.0, motion = 0.0;  // [J], at the begin
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
    double height = 0.0, motion = 0.0;  // [J], now
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
