// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One step of rigid bodies under forces among static objects: contacts, friction, energy, sleep.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/contact_joints.hpp"
#include "reckon/haptics/bodies/free_motion.hpp"
#include "reckon/haptics/bodies/impacts.hpp"
#include "reckon/haptics/bodies/island_energy.hpp"
#include "reckon/haptics/bodies/island_plan.hpp"
#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/bodies/rigid_body.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// A force on a body in one step.
struct BodyForce {
  std::size_t slot = 0;                             // slot of the body
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< [m], in the axes of its shape
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N], S
  /// [N m], S: it resists the rotation of the body; its work is not the hand's.
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  double work = 0.0;  ///< [J], work of the force, set by the step
  double made =
      0.0;  // [J], part of it from the final velocity, before the solver's energy is taken out
};

/// Bounds of the work of a step.
struct StepBudget {
  double seconds = std::numeric_limits<double>::infinity();  ///< for solutions, see CountedWork
  BodySet pushed = 0;                                        ///< bodies whose islands come first
  bool has_impacts = true;  ///< false: bodies meet at the end of the step
};

/// ODE's world of the bodies with a slot, and of static objects. It allocates nothing after some
/// steps. One thread at a time.
class BodySolver {
 public:
  static constexpr double kNear = 5e-4;  ///< [m], distance of boxes whose bodies may touch

  /// @param gravity [m/s^2], S @throws std::invalid_argument for an object that cannot be a body
  BodySolver(const EffectPlan& plan, const Eigen::Vector3d& gravity, const WorkSpace& work_space);
  ~BodySolver();
  BodySolver(const BodySolver&) = delete;
  BodySolver& operator=(const BodySolver&) = delete;

  [[nodiscard]] const BodySlots& slots() const noexcept { return *slots_; }
  /// For changes of slots and modes: only while only() has all bodies.
  [[nodiscard]] BodySlots& slots() noexcept { return *slots_; }
  /// Slots in use. The functions below take a slot.
  [[nodiscard]] std::size_t size() const noexcept { return slots_->size(); }
  [[nodiscard]] std::size_t body(std::size_t slot) const noexcept { return body_at(slot).number; }
  [[nodiscard]] double mass(std::size_t slot) const noexcept { return body_at(slot).mass; }
  /// Counted work of a step of these bodies with their last noted contacts [s].
  [[nodiscard]] double work_of(BodySet some) const noexcept;
  /// Only carry() moves it.
  [[nodiscard]] bool is_carried(std::size_t slot) const noexcept {
    return body_at(slot).is_carried;
  }
  /// Sets the pose of a carried object; in the next steps it moves at this velocity.
  void carry(std::size_t slot, const ObjectMotion& motion) noexcept { body_at(slot).carry(motion); }
  [[nodiscard]] ObjectMotion motion(std::size_t slot) const noexcept {
    return body_at(slot).motion();
  }
  [[nodiscard]] bool awake(std::size_t slot) const noexcept;
  /// Box of a body [m], S.
  [[nodiscard]] Eigen::AlignedBox3d box(std::size_t slot) const noexcept {
    return box_of(body_at(slot).geom);
  }
  /// Least principal moment of inertia [kg m^2].
  [[nodiscard]] double least_inertia(std::size_t slot) const noexcept {
    return body_at(slot).least_inertia;
  }
  /// Velocity of a point in the body's axes [m/s].
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t slot,
                                         const Eigen::Vector3d& place) const noexcept {
    return body_at(slot).velocity_of(place);
  }

  /// `some` and all bodies in contact with them, directly or through others.
  [[nodiscard]] BodySet island(BodySet some) const noexcept { return slots_->near(some, kNear); }
  /// The next steps neither move bodies outside `some` nor collide with them.
  void only(BodySet some) noexcept;
  [[nodiscard]] static constexpr BodySet all() noexcept { return ~BodySet{0}; }

  /// Advances by dt [s]. Energy that the solver adds beyond the work of the forces is taken out of
  /// the bodies' velocities in the same step.
  void step(double dt, std::span<BodyForce> forces) noexcept;
  /// Bounds each further step.
  void allow(const StepBudget& budget) noexcept { budget_ = budget; }
  /// Counted work of all steps [s].
  [[nodiscard]] double work() const noexcept { return work_; }
  /// Notes the contacts of the last step, for work_of().
  void note_contacts() noexcept;

  /// Slows a body. @param energy [J] > 0 @return the energy taken [J], at most its kinetic energy
  double take_back(std::size_t slot, double energy) noexcept;

  /// Saves the bodies of only(), and restores them.
  void keep() noexcept;
  void restore() noexcept;

  /// See BodyWorld.
  [[nodiscard]] double energy() const noexcept;
  [[nodiscard]] double taken_out() const noexcept { return tally_.taken_out; }
  [[nodiscard]] std::uint64_t approximated() const noexcept { return tally_.lost; }

 private:
  struct Tally {
    double taken_out = 0.0;  // [J]
    std::uint64_t lost = 0;
  };

  void destroy() noexcept;
  [[nodiscard]] RigidBody& body_at(std::size_t slot) noexcept { return (*slots_)[slot]; }
  [[nodiscard]] const RigidBody& body_at(std::size_t slot) const noexcept {
    return (*slots_)[slot];
  }
  [[nodiscard]] bool acts(std::size_t slot) const noexcept { return (only_ >> slot & 1) != 0; }
  // Visits the slots of only(), ascending.
  void each_acting(auto&& visit) const { slots_->each(only_, visit); }
  [[nodiscard]] bool rests() const noexcept;
  void apply(std::span<BodyForce> forces) noexcept;
  void time_speeds(double dt) noexcept;
  void solve(BodySet but, double dt) noexcept;
  void strike(BodySet bodies) noexcept;
  [[nodiscard]] bool solve_exactly(BodySet some, double dt) noexcept;
  void iterate(const PlannedIsland& island, double dt) noexcept;
  void put_back(BodySet some) noexcept;
  void step_alone(BodySet some, auto&& step) noexcept;
  void book_lifted_ahead(double dt) noexcept;
  void meet_sleeping() noexcept;
  void count_bodies() noexcept;
  void take_out(double dt, std::span<BodyForce> forces) noexcept;

  StepHost host_;  // outlives the world
  dWorldID world_ = nullptr;
  std::optional<BodyGeoms> geoms_;  // constructed after ODE's initialization
  IslandEnergy energy_;
  std::optional<ContactJoints> joints_;
  Eigen::Vector3d gravity_;
  std::optional<BodySlots> slots_;  // refers to the world and geoms_
  std::optional<FreeMotion> motion_;
  std::optional<Impacts> impacts_;
  BodySet only_ = all();
  BodySet parked_awake_ = 0;  // awake bodies outside only()
  IslandPlan plan_;
  StepBudget budget_;
  double work_ = 0.0;  // [s]
  Tally tally_, kept_;
};

}  // namespace reckon::haptics
