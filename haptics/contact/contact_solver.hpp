// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contact of one probe with all objects of a plan. One surface contact point (SCP) stays outside
// all of them. A tree of boxes excludes distant objects. The forces of the objects that hold the
// SCP are summed. Runs inside the servo step.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "reckon/haptics/contact/contact_result.hpp"
#include "reckon/haptics/contact/felt_object.hpp"
#include "reckon/haptics/contact/moving_objects.hpp"
#include "reckon/haptics/contact/object_obstacles.hpp"
#include "reckon/haptics/geometry/contact_walk.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// One SCP for all objects, kept outside each of them to within its clearance (1e-7 of its size).
/// If only one object is within reach, the SCP settles in that object's own closed form or walk. If
/// there are several, planes of all of them hold it. |device - scp| is then split into one share
/// per holding object (contact_shares.hpp), on which that object's springs act.
///
/// For a device at rest no step raises |device - scp|, and the sum of the springs has no curvature
/// above the stiffest of them: the storage of a passive virtual wall. Where objects of different
/// stiffness meet, the energy may jump as one takes over from another. The user must therefore book
/// all of it, as StaticContact does.
///
/// If no position outside all objects is found, as between planes that leave none, the SCP starts
/// inside. The contact is still passive, held by the surfaces that the SCP meets from there.
class ContactSolver {
 public:
  /// @param plan outlives the solver; solvers that share it only read it
  /// @param radius of the probe [m], >= 0: the SCP is its centre
  /// @param patch_cap [N/m], limit of the stiffness of mesh patches
  explicit ContactSolver(const EffectPlan& plan, double radius = 0.0,
                         double patch_cap = std::numeric_limits<double>::infinity());
  ContactSolver(const ContactSolver&) = delete;
  ContactSolver& operator=(const ContactSolver&) = delete;

  /// Restarts at `device` [m, S]. If that lies inside objects, the SCP is put outside nearby and
  /// started_inside is set. No allocation; examines every object, tens of nanoseconds each, or tens
  /// of microseconds for a mesh.
  ContactResult reset(const Eigen::Vector3d& device) noexcept;

  /// Ends the contact with a moving object after the device has been outside of it for 50 ms, at
  /// least 10 mm farther from the SCP than `force` [N], the greatest rendered force, stretches the
  /// object's springs.
  void let_through_beyond(double force) noexcept { strongest_ = force; }
  /// Lost storage of the contacts that ended in this way in the last step [J].
  [[nodiscard]] double lost() const noexcept { return lost_; }
  /// Number of contacts that ended in this way.
  [[nodiscard]] std::uint32_t passed() const noexcept { return passed_; }

  /// Number of moving objects in the last step.
  [[nodiscard]] std::size_t placed() const noexcept { return moving_.placed().size(); }
  /// Sets the state of a moving object before a step. The step considers only objects placed since
  /// the last one. The SCP moves with the body that holds it; other bodies push it.
  /// @param before state one step ago, used if the object was not placed for the last step
  void place(std::uint32_t body, const ObjectMotion& motion, const ObjectMotion& before) noexcept {
    moving_.place(body, motion, before, contacts_);
  }
  /// Sets whether a mover carries a moving object now, see carried_work().
  void set_carried(std::uint32_t body, bool is) noexcept { moving_.set_carried(body, is); }
  [[nodiscard]] bool is_carried(std::uint32_t i) const noexcept { return objects_[i]->carried; }
  /// Velocity of an object's material point at `point` [m, S], [m/s]; zero for a static object.
  [[nodiscard]] Eigen::Vector3d velocity_of(std::uint32_t index,
                                            const Eigen::Vector3d& point) const noexcept {
    return moving_.velocity_of(index, point);
  }
  /// Work of the carried objects on the springs in the last move, place() to step() [J]: the growth
  /// of the storage from the motion of the surfaces.
  [[nodiscard]] double carried_work() const noexcept { return moving_.carried_work(contacts_); }
  /// Time by which an object's velocity lags its position [s]; see ObjectMotion::step.
  [[nodiscard]] double ahead_of(std::uint32_t i) const noexcept { return moving_.ahead_of(i); }
  /// The next placed object from `next` on that the probe does not touch, but may touch within
  /// `time` [s] at this velocity [m/s]. @return std::nullopt: none
  [[nodiscard]] std::optional<NearBody> near_body(std::size_t& next,
                                                  const Eigen::Vector3d& velocity,
                                                  double time) const noexcept {
    return moving_.near_body(next, {last_device_, velocity, radius_, time}, contacts_);
  }
  /// Greatest ratio of tangential to normal force of an object; 0 if it is smooth.
  [[nodiscard]] double friction_of(std::uint32_t index) const noexcept {
    return cones_[index] != nullptr ? cones_[index]->at_rest() : 0.0;
  }

  /// Moves the SCP to where it settles for this device position [m, S]. Any position is allowed.
  /// One that is not finite or beyond 1e9 m gives no force and the last scp, and changes nothing.
  /// The first call resets. No allocation. Examines the objects touched before and those no farther
  /// from the device than the SCP was: logarithmic in all others.
  /// @param dt [s] > 0, since the last step: for friction that depends on the sliding speed
  ContactResult step(const Eigen::Vector3d& device, double dt = 0.001) noexcept;

  /// Changes to the patches below the SCP, as PatchBlend does: the contacts stay and their springs
  /// change. A new contact begins with its patch at once. No allocation.
  /// @param dt [s], since the last step  @param energy [J] >= 0, available for growing springs
  ContactResult follow_patches(double dt, double energy) noexcept;
  /// Whether any object touched has patches.
  [[nodiscard]] bool on_patches() const noexcept;
  /// Share of the touched patches' stiffness that the energy allowed, (0, 1].
  [[nodiscard]] double patch_share() const noexcept { return patch_share_; }
  /// Shortens the springs of the touched objects to `share` [0, 1] of their depth. The rest is
  /// hidden, as if the surface were nearer to the device, until the device moves out by as much. No
  /// allocation.
  ContactResult hide(double share) noexcept;
  /// Greatest hidden depth of a touched object [m].
  [[nodiscard]] double hidden() const noexcept;
  /// Least share of a touched object's depth that is not hidden, [0, 1].
  [[nodiscard]] double shown_depth() const noexcept;
  /// Present stiffness of all springs of an object together [N/m].
  [[nodiscard]] double stiffness_of(std::uint32_t index) const noexcept {
    return states_[index].stiffness();
  }

  /// Forces of the effects besides the springs [N, S], summed over objects, at the last step's
  /// contacts: dampers, and any other effect with the hook force(). Call once a step, so that an
  /// effect may keep time. Neither bounded nor surely finite: StaticContact limits it. No
  /// allocation.
  /// @param velocity of the device [m/s, S]  @param dt [s], hold time of the force  @param gain
  /// share of the springs that the device shows, [0, 1]
  [[nodiscard]] Eigen::Vector3d effect_force(const Eigen::Vector3d& velocity, double dt,
                                             double gain = 1.0) noexcept;

  /// Evaluations of friction since the last reset; zero for a scene that declares none.
  [[nodiscard]] std::uint64_t friction_calls() const noexcept;

 private:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  void carry() noexcept;
  [[nodiscard]] bool within_reach(std::uint32_t index,
                                  const Eigen::Vector3d& device) const noexcept;
  void let_through(const Eigen::Vector3d& device, double dt) noexcept;
  void find_near(const Eigen::Vector3d& device) noexcept;
  void place_outside(const Eigen::Vector3d& device) noexcept;
  void follow_place(double dt) noexcept;
  void settle(const Eigen::Vector3d& device) noexcept;
  void settle_on_one(std::uint32_t index, const Eigen::Vector3d& device) noexcept;
  void settle_among(const Eigen::Vector3d& device) noexcept;
  [[nodiscard]] SurfaceFeel goal_of(std::uint32_t index) const noexcept;
  void note_touch(std::uint32_t index, std::uint32_t triangle) noexcept;
  void feel(std::uint32_t index, const Eigen::Vector3d& scp,
            const Eigen::Vector3d& device) noexcept;
  [[nodiscard]] ContactResult nothing() const noexcept;
  [[nodiscard]] ContactResult sum(const Eigen::Vector3d& device) noexcept;

  const EffectPlan& plan_;
  MovingObjects moving_;
  std::vector<const PlannedObject*> objects_;  // objects of the plan at their present poses
  std::vector<FeltObject> states_;
  std::vector<ObjectContact> contacts_;
  double radius_;
  double patch_cap_;  // [N/m]
  double patch_share_ = 1.0;
  std::vector<FrictionCone*> cones_;    // per object; null if it is smooth
  std::vector<std::uint32_t> near_;     // objects of this step, ascending
  std::vector<std::uint32_t> reached_;  // of these, objects that the SCP may meet
  std::vector<std::uint32_t> touched_;  // of these, objects in contact
  std::vector<std::uint64_t> noted_;    // per object, the step at which it was put into near_
  std::uint64_t step_ = 1;
  bool any_follows_ = false;
  double strongest_ = std::numeric_limits<double>::infinity();  // [N]
  double lost_ = 0.0;                                           // [J]
  std::uint32_t passed_ = 0;
  std::uint32_t left_out_ = kNobody;                       // object that the SCP does not meet
  std::uint32_t alone_ = kNobody;                          // object whose own SCP is the newest
  Eigen::Vector3d scp_ = Eigen::Vector3d::Zero();          // S
  Eigen::Vector3d last_device_ = Eigen::Vector3d::Zero();  // S, of the last finite step
  bool started_ = false;
};

}  // namespace reckon::haptics
