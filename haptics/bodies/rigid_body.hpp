// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body of a plan, and its ODE body while it is active.
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
/// Bounding box [m], S.
[[nodiscard]] Eigen::AlignedBox3d box_of(dGeomID geom) noexcept;

/// Properties of a body, and its pose while inactive.
struct BodyKind {
  dGeomID geom = nullptr;    ///< null: a carried solid without contacts
  std::size_t number = 0;    ///< number of the body
  std::uint32_t object = 0;  ///< index in the plan
  bool is_carried = false;
  bool can_be_owned = false;  ///< it has a mass; its mode may change
  double effort = 1.0;        ///< cost of a step, over a box
  double mass = 0.0;          ///< [kg]; 0: carried
  double whole_mass = 0.0;    ///< [kg], while it is owned
  double drag = 0.0;          ///< [N s/m]
  double inner = 0.0;  ///< [m], radius of the largest ball around its center of mass inside it
  double least_inertia = 0.0;  ///< [kg m^2], least principal moment
  double account = 0.0;        ///< [J], see IslandEnergy
  dMass inertia{};
  Eigen::Vector3d middle =
      Eigen::Vector3d::Zero();                      ///< center of mass in the axes of its shape [m]
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< initial center of mass [m], S
  Eigen::Vector3d at = Eigen::Vector3d::Zero();     ///< present center of mass [m], S
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  [[nodiscard]] ObjectMotion lying() const noexcept {
    return {at - orientation * middle, orientation};
  }
  /// Potential energy, relative to its start [J]. @param where center of mass [m] @param gravity
  /// [m/s^2], S
  [[nodiscard]] double height_energy(const Eigen::Vector3d& where,
                                     const Eigen::Vector3d& gravity) const noexcept {
    return -mass * gravity.dot(where - start);
  }
};

/// An active body.
struct RigidBody : BodyKind {
  /// Pose and motion.
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
  bool flies = true;              ///< only its weight acts on it in this step
  double lag = 0.0;               ///< [s], time by which its velocity lags its position
  std::size_t island = 0;         ///< a slot of its contact island in the last step; its own: none
  double contacts = 0.0;          ///< of its last step, see ContactJoints::contacts_of()
  State before, kept;             ///< before the step; of BodySolver::keep()
  Eigen::AlignedBox3d clear;      ///< [m], S: box without inactive bodies, see BodySlots
  std::uint64_t clear_since = 0;  ///< number of additions at which `clear` was valid; 0: unknown

  [[nodiscard]] bool is_awake() const noexcept { return dBodyIsEnabled(id) != 0; }
  [[nodiscard]] State state() const noexcept;
  void set(const State& state) noexcept;
  [[nodiscard]] Eigen::Quaterniond turned() const noexcept;
  /// Motion of its shape's axes.
  [[nodiscard]] ObjectMotion motion() const noexcept;
  /// Velocity of a point in the shape's axes [m/s].
  [[nodiscard]] Eigen::Vector3d velocity_of(const Eigen::Vector3d& place) const noexcept;
  /// [J]
  [[nodiscard]] double kinetic_energy() const noexcept;
  /// Potential energy [J]; 0 if carried. @param gravity [m/s^2], S
  [[nodiscard]] double weight_energy(const Eigen::Vector3d& gravity) const noexcept;
  /// Kinetic and potential energy plus a positive account, see IslandEnergy [J].
  [[nodiscard]] double energy(const Eigen::Vector3d& gravity) const noexcept;
  /// Puts an owned body into a state and wakes it, at most at BodyWorld's limits of speed.
  void start(const ObjectMotion& motion) noexcept;
  /// Moves it, without a change of velocity. @param way [m], S @param turned its new orientation
  void shift(const Eigen::Vector3d& way, const Eigen::Quaterniond& turned) noexcept;
  /// Makes it active.
  void wake() noexcept;
  /// Sets pose and velocity of a carried object.
  void carry(const ObjectMotion& motion) noexcept;
  /// Applies a force; if it is not zero, wakes the body. @param place in the axes of its shape [m]
  /// @param force [N]  @param torque [N m], S, for the next step
  void push(const Eigen::Vector3d& place, const Eigen::Vector3d& force,
            const Eigen::Vector3d& torque) noexcept;
  /// Gives it an impulse [N s] at a point [m], S, and wakes it.
  void strike(const Eigen::Vector3d& impulse, const Eigen::Vector3d& point) noexcept;
  /// Multiplies its velocities.
  void slow(double factor) noexcept;

 private:
  void put(const ObjectMotion& motion) noexcept;
  void limit_speed() noexcept;
};

}  // namespace reckon::haptics
