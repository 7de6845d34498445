// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/impacts.hpp"

#include <array>
#include <span>

#include "reckon/haptics/queries/time_of_impact.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kLeastWay = 1e-4;     // [m], motion of both bodies in the step
constexpr double kLeastShared = 5e-4;  // [m], the same if others touch or push them
constexpr double kTolerance = 1e-6;    // [m], error of the distance at the impact
constexpr double kTouch = 2e-6;        // [m], further motion of both, so that they touch
constexpr double kLeastSpeed = 1e-3;   // [m/s], least assumed closing speed
constexpr std::size_t kMostPlaces = 8;
constexpr int kAdvances = 32;  // a pair that slides closely needs more: it meets at the step's end

bool moves(dGeomID geom) noexcept {
  const dBodyID body = dGeomGetBody(geom);
  return body != nullptr && dBodyIsEnabled(body);
}

// Motion of the shape's axes.
Motion motion_of(dGeomID geom) noexcept {
  Motion out;
  if (dGeomGetClass(geom) != dPlaneClass) {
    out.start.position = vector_of(dGeomGetPosition(geom));
    const dReal* r = dGeomGetRotation(geom);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) out.start.orientation(i, k) = r[4 * i + k];
  } else {
    // The normal of a plane is in S.
    dVector4 plane;
    dGeomPlaneGetParams(geom, plane);
    out.start.position = plane[3] * vector_of(plane);
    out.start.orientation = BodyGeoms::matter_of(geom).turned;
  }
  if (!moves(geom)) return out;
  const dBodyID body = dGeomGetBody(geom);
  out.turn_rate = vector_of(dBodyGetAngularVel(body));
  out.velocity = vector_of(dBodyGetLinearVel(body)) +
                 out.turn_rate.cross(out.start.position - vector_of(dBodyGetPosition(body)));
  return out;
}

// Upper bound of the motion of any point of a geom in dt [m].
double way_of(dGeomID geom, double dt) noexcept {
  if (!moves(geom)) return 0.0;
  const dBodyID body = dGeomGetBody(geom);
  const Eigen::AlignedBox3d box = box_of(geom);
  return dt * (vector_of(dBodyGetLinearVel(body)).norm() +
               vector_of(dBodyGetAngularVel(body)).norm() * box.diagonal().norm());
}

}  // namespace

BodySet Impacts::find(BodySet acting, double dt) noexcept {
  found_.clear();
  alone_.clear();
  measured_ = 0;
  BodySet awake = 0;
  slots_.each(acting & ~slots_.carried(), [&](std::size_t i) {
    if (slots_[i].is_awake() && slots_[i].geom != nullptr) awake |= BodySet{1} << i;
  });
  if (awake == 0) return 0;
  list_movers(dt);
  slots_.each(awake, [&](std::size_t i) {
    const auto one = std::ranges::find(movers_, BodySet{1} << i, &Mover::body);
    if (one != movers_.end() && BodyGeoms::matter_of(one->geom).swept) find_of(*one, dt);
  });
  std::ranges::sort(found_, {}, &Meeting::time);
  BodySet taken = 0, out = 0;
  for (const Meeting& meeting : found_) {
    if ((taken & meeting.bodies) != 0) continue;
    taken |= meeting.bodies;
    if (!is_alone(meeting)) {
      if (meeting.way > kLeastShared) hand_over(meeting);
      continue;
    }
    alone_.push_back(meeting);
    out |= meeting.bodies;
  }
  return out;
}

void Impacts::list_movers(double dt) noexcept {
  movers_.clear();
  const int count = dSpaceGetNumGeoms(geoms_.space());
  for (int k = 0; k < count; ++k) {
    const dGeomID geom = dSpaceGetGeom(geoms_.space(), k);
    if (!dGeomIsEnabled(geom)) continue;
    const dBodyID body = dGeomGetBody(geom);
    const bool is_moved = body != nullptr && !dBodyIsKinematic(body);
    movers_.push_back({geom, box_of(geom), way_of(geom, dt),
                       is_moved ? BodySet{1} << slot_of(body) : BodySet{0}});
  }
}

void Impacts::find_of(const Mover& one, double dt) noexcept {
  for (const Mover& other : movers_) {
    const double both = one.way + other.way;
    if (!(both > kLeastWay) || other.geom == one.geom) continue;
    // Of two moving bodies, only one finds the meeting.
    if (other.body != 0 && other.body < one.body && moves(other.geom)) continue;
    if (!(one.box.squaredExteriorDistance(other.box) < both * both)) continue;
    test(one.geom, other.geom, one.body | other.body, both, dt);
  }
}

void Impacts::test(dGeomID a, dGeomID b, BodySet bodies, double way, double dt) noexcept {
  const GeomMatter &one = BodyGeoms::matter_of(a), &other = BodyGeoms::matter_of(b);
  if (!other.swept || joints_.have_met(a, b)) return;
  const ImpactTime found = time_of_impact(*one.swept, motion_of(a), *other.swept, motion_of(b), dt,
                                          kTolerance, kAdvances);
  measured_ += found.advances;
  if (found.outcome == Impact::hit && found.time < dt)
    found_.push_back({found.time, way, a, b, bodies});
}

// Whether nothing else touches or pushes them.
bool Impacts::is_alone(const Meeting& meeting) const noexcept {
  const dBodyID other = dGeomGetBody(meeting.b);
  if (other != nullptr && dBodyIsKinematic(other)) return false;
  bool is = true;
  slots_.each(meeting.bodies, [&](std::size_t i) {
    is &= slots_[i].is_awake() && slots_[i].flies && dBodyGetNumJoints(slots_[i].id) == 0;
  });
  return is;
}

// Moves the bodies of an impact until they touch. @return the time until then [s]
double Impacts::reach(const Meeting& meeting, double dt) noexcept {
  slots_.each(meeting.bodies, [&](std::size_t i) { motion_.fly(i, meeting.time); });
  const Motion a = motion_of(meeting.a), b = motion_of(meeting.b);
  const GeomMatter &one = BodyGeoms::matter_of(meeting.a), &other = BodyGeoms::matter_of(meeting.b);
  const PairMeasure near = measure_pair(*one.swept, a.start, *other.swept, b.start);
  const auto velocity = [](const Motion& motion, const Vector3d& at) -> Vector3d {
    return motion.velocity + motion.turn_rate.cross(at - motion.start.position);
  };
  const double closing = (velocity(a, near.on_a) - velocity(b, near.on_b)).dot(near.direction);
  const double more = (near.distance.most + kTouch) / std::max(closing, kLeastSpeed);
  const double rest = std::min(more, dt - meeting.time);
  slots_.each(meeting.bodies, [&](std::size_t i) { motion_.fly(i, rest); });
  return meeting.time + rest;
}

bool Impacts::touch(const Meeting& meeting) noexcept {
  joints_.remove();
  std::array<dContactGeom, kMostPlaces> room;
  const std::span<dContactGeom> places = BodyGeoms::meet(meeting.a, meeting.b, room);
  joints_.add(meeting.a, meeting.b, places, ContactJoints::Hardness::exact);
  return !places.empty();
}

// Restores a body's pose before the step and keeps its velocity.
void Impacts::stay(RigidBody& body) noexcept {
  const auto& at = body.before.at;
  const auto& q = body.before.turned;
  const dQuaternion turned{q[0], q[1], q[2], q[3]};
  dBodySetPosition(body.id, at[0], at[1], at[2]);
  dBodySetQuaternion(body.id, turned);
}

// Gives the contact at the impact to the solver of the step, which keeps both apart at their
// present poses.
void Impacts::hand_over(const Meeting& meeting) noexcept {
  std::array<RigidBody::State, 2> before;
  std::size_t count = 0;
  Vector3d way = Vector3d::Zero();
  slots_.each(meeting.bodies, [&](std::size_t i) { before[count++] = slots_[i].state(); });
  static_cast<void>(reach(meeting, meeting.time + kTouch / kLeastSpeed));
  std::array<dContactGeom, kMostPlaces> room;
  const std::span<dContactGeom> places = BodyGeoms::meet(meeting.a, meeting.b, room);
  std::size_t k = 0;
  slots_.each(meeting.bodies, [&](std::size_t i) {
    const Vector3d at = vector_of(dBodyGetPosition(slots_[i].id));
    slots_[i].set(before[k]);
    way += (at - vector_of(dBodyGetPosition(slots_[i].id))) / static_cast<double>(count);
    ++k;
  });
  for (dContactGeom& place : places) {
    for (int axis = 0; axis < 3; ++axis) place.pos[axis] -= way[axis];
    place.depth = 0.0;
  }
  joints_.add(meeting.a, meeting.b, places);
}

}  // namespace reckon::haptics
