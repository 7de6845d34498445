// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One step of rigid bodies under forces, among what stands still: contacts, friction, energy, rest.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/contact_joints.hpp"
#include "reckon/haptics/bodies/free_motion.hpp"
#include "reckon/haptics/bodies/impacts.hpp"
#include "reckon/haptics/bodies/island_energy.hpp"
#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/bodies/rigid_body.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// A force on a body in one step.
struct BodyForce {
  std::size_t slot = 0;                             // of the body
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< [m], in the axes of its shape
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N], S
  /// [N m], S: it holds the body against turning, and its work is none of the hand's.
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  double work = 0.0;  ///< [J], that it did, after the step
  double made = 0.0;  // of that, by the speed at the end, before the solver's energy was taken out
};

/// ODE's world of the bodies of a plan that have a slot, and what stands still. After some steps it
/// allocates nothing. One thread at a time.
class BodySolver {
 public:
  static constexpr double kNear = 5e-4;  ///< [m], between the boxes of bodies that may touch

  /// @param gravity [m/s^2], S  @throws std::invalid_argument for a body that cannot be one
  BodySolver(const EffectPlan& plan, const Eigen::Vector3d& gravity, const WorkSpace& work_space);
  ~BodySolver();
  BodySolver(const BodySolver&) = delete;
  BodySolver& operator=(const BodySolver&) = delete;

  [[nodiscard]] const BodySlots& slots() const noexcept { return *slots_; }
  /// See BodySlots. Only while all act.
  std::size_t take_in(std::size_t body, BodySet pinned) noexcept {
    return slots_->take_in(body, pinned);
  }

  /// See BodySlots.
  template <class Visit>
  void visit_asleep(std::size_t slot, const Eigen::AlignedBox3d& box, Visit&& visit) {
    slots_->visit_asleep(slot, box, visit);
  }

  /// Slots in use. The following are of slots.
  [[nodiscard]] std::size_t size() const noexcept { return slots_->size(); }
  [[nodiscard]] std::size_t body(std::size_t slot) const noexcept { return body_at(slot).number; }
  [[nodiscard]] double mass(std::size_t slot) const noexcept { return body_at(slot).mass; }
  /// See BodyKind.
  [[nodiscard]] double effort(std::size_t slot) const noexcept { return body_at(slot).effort; }
  /// Moved by carry() alone.
  [[nodiscard]] bool is_carried(std::size_t slot) const noexcept {
    return body_at(slot).is_carried;
  }
  /// Puts a carried one there; in the next steps it goes on at this velocity.
  void carry(std::size_t slot, const ObjectMotion& motion) noexcept { body_at(slot).carry(motion); }
  [[nodiscard]] ObjectMotion motion(std::size_t slot) const noexcept {
    return body_at(slot).motion();
  }
  [[nodiscard]] bool awake(std::size_t slot) const noexcept;
  /// Box of a body [m], S.
  [[nodiscard]] Eigen::AlignedBox3d box(std::size_t slot) const noexcept {
    return box_of(body_at(slot).geom);
  }
  /// Of its principal ones [kg m^2].
  [[nodiscard]] double least_inertia(std::size_t slot) const noexcept {
    return body_at(slot).least_inertia;
  }
  /// Of a place in the body's axes [m/s].
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t slot,
                                         const Eigen::Vector3d& place) const noexcept {
    return body_at(slot).velocity_of(place);
  }

  /// `some` and all that lie against one another with them.
  [[nodiscard]] BodySet island(BodySet some) const noexcept;
  /// Bodies outside `some` are neither moved nor met by the next steps.
  void only(BodySet some) noexcept;
  [[nodiscard]] static constexpr BodySet all() noexcept { return ~BodySet{0}; }

  /// Goes on by dt [s]. Energy that the solver makes beyond the work of the forces is taken out of
  /// the bodies' speeds in the same step.
  void step(double dt, std::span<BodyForce> forces) noexcept;

  /// Slows a body. @param energy [J] > 0, at most  @return how much it had of that
  double take_back(std::size_t slot, double energy) noexcept;

  /// Keeps the bodies of only(), and puts them back as they were kept.
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
  // Those of only(), in their order.
  template <class Visit>
  void each_acting(Visit&& visit) const {
    slots_->each(only_, visit);
  }
  [[nodiscard]] bool rests() const noexcept;
  void apply(std::span<BodyForce> forces) noexcept;
  void time_speeds(double dt) noexcept;
  void solve(BodySet but, double dt) noexcept;
  void strike(BodySet bodies) noexcept;
  [[nodiscard]] bool solve_exactly(BodySet some, double dt) noexcept;
  void iterate(BodySet island, std::size_t one, double dt) noexcept;
  [[nodiscard]] BodySet island_in_touch(std::size_t one, BodySet among) noexcept;
  void put_back(BodySet some) noexcept;
  template <class Step>
  void step_alone(BodySet some, Step&& step) noexcept;
  void book_lifted_ahead(double dt) noexcept;
  void meet_sleeping() noexcept;
  void take_out(double dt, std::span<BodyForce> forces) noexcept;
  void rest(double dt) noexcept;

  StepHost host_;  // outlives the world
  dWorldID world_ = nullptr;
  std::optional<BodyGeoms> geoms_;  // begins when ODE has
  IslandEnergy energy_;
  std::optional<ContactJoints> joints_;
  Eigen::Vector3d gravity_;
  std::optional<BodySlots> slots_;  // within the world, and geoms_
  std::optional<FreeMotion> motion_;
  std::optional<Impacts> impacts_;
  BodySet only_ = all();
  BodySet parked_awake_ = 0;  // of those that only() leaves out
  Tally tally_, kept_;
};

}  // namespace reckon::haptics
