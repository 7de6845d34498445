// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies that meet within a step: at the time, place and direction of their impact, not where the
// step would end.
#pragma once

#include <algorithm>
#include <vector>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/contact_joints.hpp"
#include "reckon/haptics/bodies/free_motion.hpp"

namespace reckon::haptics {

/// Impacts of balls, boxes and cylinders with one another and with planes; other shapes meet where
/// a step ends. A pair that touches nothing else and that nothing pushes flies to its impact in
/// closed form, takes its impulse, and flies on. For any other pair the contact at the time of
/// impact goes to the solver of the step. A body has one impact in a step, the first.
///
/// Pairs that together move less than 0.1 mm in a step meet where it ends; less than 0.5 mm where
/// others touch or push them. One thread; after some steps it allocates nothing.
class Impacts {
 public:
  /// [s], length of the step in which the impulse of an impact is solved.
  static constexpr double kInstant = 1e-6;

  /// @param geoms, slots, joints, motion outlive this
  Impacts(const BodyGeoms& geoms, BodySlots& slots, ContactJoints& joints, FreeMotion& motion)
      : geoms_(geoms), slots_(slots), joints_(joints), motion_(motion) {}

  /// Finds those of a step of dt [s], after all that touches has met. @param acting bodies
  /// @return bodies that pass() is to move; the solver of the step leaves them as they are
  [[nodiscard]] BodySet find(BodySet acting, double dt) noexcept;
  /// Moves the bodies that find() returned by dt [s]. The contacts of the step are gone after it.
  /// @param solve called with a body or two where they touch, to step them by kInstant
  template <class Solve>
  void pass(double dt, Solve&& solve) noexcept {
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
    double time = 0.0;  // [s], since the begin of the step
    double way = 0.0;   // [m], that both move in the step
    dGeomID a = nullptr, b = nullptr;
    BodySet bodies = 0;  // that move: one or two
  };
  void find_of(std::size_t slot, double dt) noexcept;
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
};

}  // namespace reckon::haptics
