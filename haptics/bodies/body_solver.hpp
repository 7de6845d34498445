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
#include "reckon/haptics/bodies/contact_islands.hpp"
#include "reckon/haptics/bodies/flight.hpp"
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
  void carry(std::size_t slot, const ObjectMotion& motion) noexcept;
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
  [[nodiscard]] double taken_out() const noexcept { return ledger_.taken_out; }
  [[nodiscard]] std::uint64_t approximated() const noexcept { return ledger_.lost; }

 private:
  struct Ledger {
    double energy = 0.0;  // [J], that the bodies may have
    double taken_out = 0.0;
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
  void solve(double dt) noexcept;
  [[nodiscard]] double lifted_ahead(double dt) const noexcept;
  void collide(dGeomID a, dGeomID b) noexcept;
  void meet_sleeping() noexcept;
  void note_contacts(dBodyID first, dBodyID second, int count) noexcept;
  [[nodiscard]] Walls walls_of(const RigidBody& body, int axis) const noexcept;
  void fly_exactly(double dt) noexcept;
  void catch_fast() noexcept;
  [[nodiscard]] double length_free(const RigidBody& body, const Eigen::Vector3d& from,
                                   const Eigen::Vector3d& way, double length) noexcept;
  void take_out(double given) noexcept;
  void rest(double dt) noexcept;

  StepHost host_;  // outlives the world
  dWorldID world_ = nullptr;
  std::optional<BodyGeoms> geoms_;  // begins when ODE has
  dJointGroupID joints_ = nullptr;
  dGeomID ray_ = nullptr;  // in no space
  Eigen::Vector3d gravity_;
  WorkSpace work_space_;
  std::optional<BodySlots> slots_;            // within the world, and geoms_
  ContactIslands<BodySlots::kMost> islands_;  // of a step
  bool is_driven_ = false;  // something that is carried touches a body in this step
  BodySet only_ = all();
  BodySet parked_awake_ = 0;    // of those that only() leaves out
  double parked_energy_ = 0.0;  // [J], of the same
  Ledger ledger_, kept_;
};

}  // namespace reckon::haptics
