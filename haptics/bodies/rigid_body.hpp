// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body of a plan, and how ODE has it while it takes part.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

[[nodiscard]] inline Eigen::Vector3d vector_of(const dReal* v) noexcept {
  return {v[0], v[1], v[2]};
}
/// [m], S.
[[nodiscard]] Eigen::AlignedBox3d box_of(dGeomID geom) noexcept;

/// What a body is, and how it lies while it takes no part.
struct BodyKind {
  dGeomID geom = nullptr;    ///< null of a carried solid that nothing meets
  std::size_t number = 0;    ///< of the body
  std::uint32_t object = 0;  ///< its number in the plan
  bool is_carried = false;
  double effort = 1.0;         ///< of a step, over that of a box
  double mass = 0.0;           ///< [kg]; 0 of what is carried
  double drag = 0.0;           ///< [N s/m]
  double inner = 0.0;          ///< [m], radius of the ball about its middle within it
  double least_inertia = 0.0;  ///< [kg m^2], of its principal ones
  double account = 0.0;        ///< [J], see IslandEnergy
  dMass inertia{};
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of mass, in the axes of its shape [m]
  Eigen::Vector3d start = Eigen::Vector3d::Zero();   ///< of the middle [m], S
  Eigen::Vector3d at = Eigen::Vector3d::Zero();      ///< of the middle [m], S
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  [[nodiscard]] ObjectMotion lying() const noexcept {
    return {at - orientation * middle, orientation};
  }
  /// Of its weight, above its start [J]. @param at of the middle [m]  @param gravity [m/s^2], S
  [[nodiscard]] double height_energy(const Eigen::Vector3d& where,
                                     const Eigen::Vector3d& gravity) const noexcept {
    return -mass * gravity.dot(where - start);
  }
};

/// One that takes part.
struct RigidBody : BodyKind {
  /// How it stands and moves.
  struct State {
    std::array<dReal, 3> at{}, velocity{}, turn_rate{}, force{}, torque{};
    std::array<dReal, 4> turned{};
    bool awake = true;
    double still = 0.0;    // [s]
    double account = 0.0;  // [J]
    double lag = 0.0;      // [s]
  };

  dBodyID id = nullptr;
  double still = 0.0;             ///< [s]
  bool flies = true;              ///< nothing pushes it in this step but its weight
  double lag = 0.0;               ///< [s], by which its speed is older than its place
  State before, kept;             ///< of a step; of BodySolver::keep()
  Eigen::AlignedBox3d clear;      ///< [m], S: where no body without a slot was, BodySlots
  std::uint64_t clear_since = 0;  ///< as of which of its changes; 0: nothing is known

  [[nodiscard]] bool is_awake() const noexcept { return dBodyIsEnabled(id) != 0; }
  [[nodiscard]] State state() const noexcept;
  void set(const State& state) noexcept;
  [[nodiscard]] Eigen::Quaterniond turned() const noexcept;
  /// Of its shape's axes.
  [[nodiscard]] ObjectMotion motion() const noexcept;
  /// Of a place in the same [m/s].
  [[nodiscard]] Eigen::Vector3d velocity_of(const Eigen::Vector3d& place) const noexcept;
  /// [J]
  [[nodiscard]] double kinetic_energy() const noexcept;
  /// Of its weight [J]; 0 of what is carried. @param gravity [m/s^2], S
  [[nodiscard]] double weight_energy(const Eigen::Vector3d& gravity) const noexcept;
  /// Both, and what is kept to lift it, see IslandEnergy [J].
  [[nodiscard]] double energy(const Eigen::Vector3d& gravity) const noexcept;
  /// Puts one that is carried there, to go on at this velocity.
  void carry(const ObjectMotion& motion) noexcept;
  /// Wakes it for a force other than zero. @param place in the axes of its shape [m]
  /// @param force [N]  @param torque [N m], S, for the next step
  void push(const Eigen::Vector3d& place, const Eigen::Vector3d& force,
            const Eigen::Vector3d& torque) noexcept;
  /// Multiplies its speeds.
  void slow(double factor) noexcept;
};

}  // namespace reckon::haptics
