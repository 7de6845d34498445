// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/time_of_impact.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

// Greatest speed of any point by rotation [m/s], at `rate` [rad/s]; 0 for an unbounded shape that
// does not rotate.
double turning_speed(const QueryShape& shape, double rate) {
  return rate > 0.0 ? rate * shape.turning_reach() : 0.0;
}

// Upper bound of the closing speed from now on [m/s].
class ClosingSpeed {
 public:
  ClosingSpeed(const QueryShape& a, const Motion& a_moves, const QueryShape& b,
               const Motion& b_moves)
      : a_(a),
        b_(b),
        turn_a_(a_moves.turn_rate),
        turn_b_(b_moves.turn_rate),
        approach_(a_moves.velocity - b_moves.velocity),
        convex_(a.is_convex() && b.is_convex()) {}

  // A slab across `direction` separates convex shapes; only motion along `direction` narrows it.
  [[nodiscard]] double along(const Vector3d& direction) const {
    if (!convex_)
      return approach_.norm() + turning_speed(a_, turn_a_.norm()) +
             turning_speed(b_, turn_b_.norm());
    return approach_.dot(direction) + turning_speed(a_, turn_a_.cross(direction).norm()) +
           turning_speed(b_, turn_b_.cross(direction).norm());
  }

 private:
  const QueryShape& a_;
  const QueryShape& b_;
  Vector3d turn_a_, turn_b_, approach_;
  bool convex_;
};

bool is_finite(const Motion& motion) {
  return motion.start.position.allFinite() && motion.start.orientation.allFinite() &&
         motion.velocity.allFinite() && motion.turn_rate.allFinite();
}

Motion from(Motion motion, const Vector3d& origin) {
  motion.start.position -= origin;
  return motion;
}

void move_back(PairMeasure& m, const Vector3d& origin) {
  m.on_a += origin;
  m.on_b += origin;
}

}  // namespace

Placement Motion::at(double time) const noexcept {
  Placement moved = start;
  moved.position += time * velocity;
  const double rate = turn_rate.norm();
  if (rate > 0.0)
    moved.orientation =
        Eigen::AngleAxisd(rate * time, turn_rate / rate).toRotationMatrix() * start.orientation;
  return moved;
}

ImpactTime time_of_impact(const QueryShape& a, const Motion& a_moves, const QueryShape& b,
                          const Motion& b_moves, double horizon, double tolerance,
                          int most) noexcept {
  ImpactTime found;
  if (!is_finite(a_moves) || !is_finite(b_moves)) return found;
  // An origin near the shapes, so that the error scales with their distance.
  const Vector3d origin = a_moves.start.position;
  const Motion one = from(a_moves, origin);
  const Motion other = from(b_moves, origin);
  const ClosingSpeed speed(a, a_moves, b, b_moves);
  PairMemory memory;
  while (found.advances < most) {
    ++found.advances;
    found.measure = measure_pair(a, one.at(found.time), b, other.at(found.time), memory);
    const double free = found.measure.distance.least;
    if (!(free > tolerance)) {
      const bool near =
          found.measure.overlap == Overlap::yes || found.measure.distance.most <= 2.0 * tolerance;
      found.outcome = near ? Impact::hit : Impact::unknown;
      break;
    }
    const double closing = speed.along(found.measure.direction);
    // Keeps half the tolerance, so that rounding does not lead into the contact.
    const double reached = found.time + (free - 0.5 * tolerance) / std::max(closing, 0.0);
    if (!(reached > found.time)) break;
    if (reached >= horizon) {
      found.time = horizon;
      found.outcome = Impact::none;
      break;
    }
    found.time = reached;
  }
  move_back(found.measure, origin);
  return found;
}

}  // namespace reckon::haptics
