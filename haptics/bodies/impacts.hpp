// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Handles impacts within a step: at the time, position and direction of the impact, not at the end
// of the step.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/contact_joints.hpp"
#include "reckon/haptics/bodies/free_motion.hpp"

namespace reckon::haptics {

/// Impacts of balls, boxes and cylinders with one another and with planes; other shapes collide at
/// the end of a step. A pair that nothing else touches or pushes flies to its impact in closed
/// form, gets its impulse, and flies on. For any other pair, the contact at the impact goes to the
/// solver of the step. A body has only its first impact in a step.
///
/// Pairs that together move less than 0.1 mm in a step (0.5 mm if others touch or push them)
/// collide at its end. One thread; it allocates nothing after some steps.
class Impacts {
 public:
  /// [s], length of the step in which the impulse of an impact is solved.
  static constexpr double kInstant = 1e-6;

  /// @param geoms, slots, joints, motion outlive this
  Impacts(const BodyGeoms& geoms, BodySlots& slots, ContactJoints& joints, FreeMotion& motion)
      : geoms_(geoms), slots_(slots), joints_(joints), motion_(motion) {
    found_.reserve(4 * BodySlots::kMost);
    alone_.reserve(BodySlots::kMost);
    movers_.reserve(2 * BodySlots::kMost);
  }

  /// Finds the impacts of a step of dt [s], after the contacts of the step. @param acting bodies
  /// @return bodies that pass() will move; the solver of the step must not move them
  [[nodiscard]] BodySet find(BodySet acting, double dt) noexcept;
  /// Distances that the last find() measured.
  [[nodiscard]] int measured() const noexcept { return measured_; }
  /// Moves the bodies that find() returned by dt [s]. Removes the contacts of the step.
  /// @param solve called with one or two touching bodies, to step them by kInstant
  void pass(double dt, auto&& solve) noexcept {
    for (const Meeting& meeting : alone_) {
      const double left = dt - reach(meeting, dt);
      slots_.each(meeting.bodies, [&](std::size_t i) { slots_[i].before = slots_[i].state(); });
      if (touch(meeting)) solve(meeting.bodies);
      slots_.each(meeting.bodies, [&](std::size_t i) {
        stay(slots_[i]);
        motion_.fly(i, left);
      });
      motion_.catch_fast(meeting.bodies);
    }
  }

 private:
  struct Meeting {
    double time = 0.0;  // [s], since the start of the step
    double way = 0.0;   // [m], motion of both in the step
    dGeomID a = nullptr, b = nullptr;
    BodySet bodies = 0;  // moving bodies: one or two
  };
  // An enabled geom at the start of the step.
  struct Mover {
    dGeomID geom = nullptr;
    Eigen::AlignedBox3d box;
    double way = 0.0;  // [m], greatest motion of a point in the step
    BodySet body = 0;  // its slot, if forces move it
  };
  void list_movers(double dt) noexcept;
  void find_of(const Mover& one, double dt) noexcept;
  void test(dGeomID a, dGeomID b, BodySet bodies, double way, double dt) noexcept;
  [[nodiscard]] bool is_alone(const Meeting& meeting) const noexcept;
  void hand_over(const Meeting& meeting) noexcept;
  double reach(const Meeting& meeting, double dt) noexcept;
  bool touch(const Meeting& meeting) noexcept;
  static void stay(RigidBody& body) noexcept;

  const BodyGeoms& geoms_;
  BodySlots& slots_;
  ContactJoints& joints_;
  FreeMotion& motion_;
  std::vector<Meeting> found_, alone_;
  std::vector<Mover> movers_;
  int measured_ = 0;
};

}  // namespace reckon::haptics
