// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_solver.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdarg>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "reckon/haptics/bodies/body_mass.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/bodies/flight.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::size_t kMostFound = 64;  // contacts of a pair with a mesh
// Of an island, up to which the exact solver is the faster one. Beyond it takes their number to the
// third power, and mostly finds no answer.
constexpr int kMostExact = 24;
// Of the other one, for one contact, so that a step of many takes no longer.
constexpr int kIterations = 2000, kFewest = 10, kMostIterations = 30;
// Depth at which contacts rest [m], so that they last from step to step.
constexpr double kRestDepth = 1e-5;
constexpr double kParting = 0.1;       // [m/s], at most, of bodies that are in one another
constexpr double kBounceSpeed = 0.01;  // [m/s]; slower hits do not bounce
constexpr double kHitSoftness = 1e-12;
constexpr double kSlipSpeed = 1e-4;   // [m/s]; faster ones rub along their way
constexpr double kStillSpeed = 1e-3;  // [m/s]
constexpr double kStillTurn = 0.02;   // [rad/s]

// The exact solver says so where it found no answer, as in a pile of many contacts at once.
thread_local bool lost = false;
void note_lost(int, const char*, va_list) { lost = true; }

void start_ode() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetMessageHandler(note_lost);
  });
}

// What ODE keeps for each thread.
void know_thread() {
  thread_local const bool known = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  static_cast<void>(known);
}

// No body, or one that goes its way whatever it meets.
bool stands(dBodyID body) noexcept { return body == nullptr || dBodyIsKinematic(body); }

// Of the first body against the second one, at a contact of both [m/s].
Vector3d velocity_at(const dContact& contact, dBodyID first, dBodyID second) noexcept {
  const Vector3d at = vector_of(contact.geom.pos);
  const auto velocity = [&](dBodyID body) -> Vector3d {
    if (body == nullptr) return Vector3d::Zero();
    return vector_of(dBodyGetLinearVel(body)) +
           vector_of(dBodyGetAngularVel(body)).cross(at - vector_of(dBodyGetPosition(body)));
  };
  return velocity(first) - velocity(second);
}

// Friction is bounded along two axes: where a contact slips, one of them is its way.
void rub_along(dContact& contact, const Vector3d& velocity) noexcept {
  const Vector3d normal = vector_of(contact.geom.normal);
  const Vector3d slip = velocity - normal.dot(velocity) * normal;
  const double speed = slip.norm();
  if (!(speed > kSlipSpeed)) return;
  contact.surface.mode |= dContactFDir1;
  for (int i = 0; i < 3; ++i) contact.fdir1[i] = slip[i] / speed;
}

}  // namespace

BodySolver::BodySolver(const EffectPlan& plan, const Vector3d& gravity, const WorkSpace& work_space)
    : gravity_(gravity), work_space_(work_space) {
  start_ode();
  know_thread();
  world_ = dWorldCreate();
  geoms_.emplace(plan.objects());
  joints_ = dJointGroupCreate(0);
  ray_ = dCreateRay(nullptr, 1.0);
  host_.serve(world_);
  dWorldSetGravity(world_, gravity.x(), gravity.y(), gravity.z());
  dWorldSetERP(world_, 0.2);
  dWorldSetCFM(world_, 1e-7);
  dWorldSetContactSurfaceLayer(world_, kRestDepth);
  dWorldSetContactMaxCorrectingVel(world_, kParting);
  try {
    slots_.emplace(world_, geoms_->space(), gravity);
    for (std::uint32_t i = 0; i < plan.objects().size(); ++i) {
      const PlannedObject& object = plan.objects()[i];
      const dGeomID geom = geoms_->add(object);
      if (object.moves()) slots_->add(object, i, geom);
    }
    slots_->fill();
  } catch (...) {
    destroy();
    throw;
  }
  ledger_.energy = energy();
}

BodySolver::~BodySolver() { destroy(); }

void BodySolver::destroy() noexcept {
  slots_.reset();
  dGeomDestroy(ray_);
  dJointGroupDestroy(joints_);
  geoms_.reset();
  dWorldDestroy(world_);
}

void BodySolver::carry(std::size_t slot, const ObjectMotion& motion) noexcept {
  const dBodyID id = body_at(slot).id;
  const Quaterniond& q = motion.orientation;
  const dQuaternion turned{q.w(), q.x(), q.y(), q.z()};
  dBodySetPosition(id, motion.position.x(), motion.position.y(), motion.position.z());
  dBodySetQuaternion(id, turned);
  const Vector3d &v = motion.velocity, &w = motion.turn_rate;
  dBodySetLinearVel(id, v.x(), v.y(), v.z());
  dBodySetAngularVel(id, w.x(), w.y(), w.z());
  if (v.isZero(0.0) && w.isZero(0.0)) {
    dBodyDisable(id);
  } else {
    dBodyEnable(id);
  }
}

bool BodySolver::awake(std::size_t slot) const noexcept {
  return acts(slot) ? body_at(slot).is_awake() : (parked_awake_ >> slot & 1) != 0;
}

double BodySolver::energy() const noexcept {
  double sum = slots_->asleep_energy() + parked_energy_;
  each_acting([&](std::size_t i) { sum += body_at(i).energy(gravity_); });
  return sum;
}

BodySet BodySolver::island(BodySet some) const noexcept {
  // What is carried joins nothing: it goes its way whatever lies on it.
  some &= ~slots_->carried();
  std::array<std::array<dReal, 6>, BodySlots::kMost> boxes;
  for (std::size_t i = 0; i < size(); ++i)
    if (!is_carried(i)) dGeomGetAABB(body_at(i).geom, boxes[i].data());
  const auto near = [&](std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < 6; k += 2) {
      if (boxes[a][k] > boxes[b][k + 1] + kNear || boxes[b][k] > boxes[a][k + 1] + kNear)
        return false;
    }
    return true;
  };
  BodySet found = some, fresh = some;
  while (fresh != 0) {
    const auto from = static_cast<std::size_t>(std::countr_zero(fresh));
    fresh &= fresh - 1;
    for (std::size_t i = 0; i < size(); ++i) {
      const BodySet one = BodySet{1} << i;
      if ((found & one) != 0 || is_carried(i) || !near(from, i)) continue;
      found |= one;
      fresh |= one;
    }
  }
  return found;
}

void BodySolver::only(BodySet some) noexcept {
  some |= slots_->carried();
  if (some == only_) return;
  parked_energy_ = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const BodySet one = BodySet{1} << i;
    const bool wanted = (some & one) != 0;
    const RigidBody& body = body_at(i);
    if (!wanted) parked_energy_ += body.energy(gravity_);
    if (wanted == acts(i)) continue;
    if (wanted) {
      dGeomEnable(body.geom);
      if ((parked_awake_ & one) != 0) dBodyEnable(body.id);
      parked_awake_ &= ~one;
    } else {
      if (body.is_awake()) parked_awake_ |= one;
      dBodyDisable(body.id);
      dGeomDisable(body.geom);
    }
  }
  only_ = some;
}

void BodySolver::keep() noexcept {
  each_acting([&](std::size_t i) { body_at(i).kept = body_at(i).state(); });
  kept_ = ledger_;
}

void BodySolver::restore() noexcept {
  each_acting([&](std::size_t i) { body_at(i).set(body_at(i).kept); });
  ledger_ = kept_;
}

// Without bodies nobody sees what is carried.
bool BodySolver::rests() const noexcept {
  if (std::popcount(slots_->carried()) == static_cast<int>(size())) return true;
  bool any = false;
  each_acting([&](std::size_t i) { any |= body_at(i).is_awake(); });
  return !any;
}

void BodySolver::step(double dt, std::span<BodyForce> forces) noexcept {
  if (forces.empty() && rests()) return;
  know_thread();
  apply(forces);
  is_driven_ = false;
  each_acting([&](std::size_t i) {
    body_at(i).flies = vector_of(dBodyGetForce(body_at(i).id)).isZero(0.0);
  });
  for (BodyForce& force : forces)
    force.work = 0.5 * dt * force.force.dot(body_at(force.slot).velocity_of(force.place));
  islands_.clear();
  dSpaceCollide(geoms_->space(), this, [](void* self, dGeomID a, dGeomID b) {
    static_cast<BodySolver*>(self)->collide(a, b);
  });
  meet_sleeping();
  solve(dt);
  double given = lifted_ahead(dt);
  fly_exactly(dt);
  catch_fast();
  dJointGroupEmpty(joints_);
  for (BodyForce& force : forces) {
    force.work += 0.5 * dt * force.force.dot(body_at(force.slot).velocity_of(force.place));
    const Vector3d turned = vector_of(dBodyGetAngularVel(body_at(force.slot).id));
    given += force.work + dt * std::max(0.0, force.torque.dot(turned));
  }
  // What carried objects did to them is not known.
  if (is_driven_) ledger_.energy = std::numeric_limits<double>::infinity();
  take_out(given);
  rest(dt);
  // What falls asleep or is too fast gives some up.
  ledger_.energy = std::min(ledger_.energy, energy());
}

// A body that is pushed moves by its new speed for all of the step, and so is lifted by half of the
// change of its speed more than the pushes did work for. It is as much less when it slows down.
double BodySolver::lifted_ahead(double dt) const noexcept {
  double sum = 0.0;
  each_acting([&](std::size_t i) {
    const RigidBody& body = body_at(i);
    const bool is_pushed =
        body.mass > 0 && !body.flies && body.is_awake() && dBodyGetNumJoints(body.id) == 0;
    if (!is_pushed) return;
    const Vector3d before(body.before.velocity[0], body.before.velocity[1],
                          body.before.velocity[2]);
    sum -= 0.5 * dt * body.mass * gravity_.dot(vector_of(dBodyGetLinearVel(body.id)) - before);
  });
  return sum;
}

// Where the exact solver would take too long or is lost, the step is taken by one that always ends
// near the answer.
void BodySolver::solve(double dt) noexcept {
  each_acting([&](std::size_t i) { body_at(i).before = body_at(i).state(); });
  lost = islands_.largest() > kMostExact;
  if (!lost) host_.step(world_, dt);
  if (!lost) return;
  ++ledger_.lost;
  each_acting([&](std::size_t i) { body_at(i).set(body_at(i).before); });
  dWorldSetQuickStepNumIterations(
      world_, std::clamp(kIterations / std::max(1, islands_.all()), kFewest, kMostIterations));
  dRandSetSeed(1);  // so that it is the same twice
  host_.quick_step(world_, dt);
}

void BodySolver::apply(std::span<BodyForce> forces) noexcept {
  for (const BodyForce& force : forces) {
    RigidBody& body = body_at(force.slot);
    if (force.force.squaredNorm() > 0 && !body.is_awake()) {
      dBodyEnable(body.id);
      body.still = 0.0;
    }
    const Vector3d at = vector_of(dBodyGetPosition(body.id)) +
                        body_at(force.slot).turned() * (force.place - body.middle);
    const Vector3d& f = force.force;
    dBodyAddForceAtPos(body.id, f.x(), f.y(), f.z(), at.x(), at.y(), at.z());
    dBodyAddTorque(body.id, force.torque.x(), force.torque.y(), force.torque.z());
  }
}

void BodySolver::collide(dGeomID a, dGeomID b) noexcept {
  const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
  const auto sleeps = [](dBodyID body) { return body == nullptr || !dBodyIsEnabled(body); };
  if (sleeps(first) && sleeps(second)) return;
  if (stands(first) && stands(second)) return;
  std::array<dContactGeom, kMostFound> room;
  const std::span<dContactGeom> found = BodyGeoms::meet(a, b, room);
  if (found.empty()) return;
  is_driven_ |= stands(first) && first != nullptr && dBodyIsEnabled(first);
  is_driven_ |= stands(second) && second != nullptr && dBodyIsEnabled(second);
  note_contacts(first, second, static_cast<int>(found.size()));
  const Matter &one = BodyGeoms::matter_of(a).matter, &other = BodyGeoms::matter_of(b).matter;
  for (const dContactGeom& place : found) {
    dContact contact{};
    contact.geom = place;
    contact.surface.mode = dContactApprox1 | dContactBounce;
    contact.surface.mu = std::sqrt(one.friction * other.friction);
    contact.surface.bounce = std::max(one.restitution, other.restitution);
    contact.surface.bounce_vel = kBounceSpeed;
    const Vector3d velocity = velocity_at(contact, first, second);
    rub_along(contact, velocity);
    // What bounces is a hit: it is over within the step.
    if (contact.surface.bounce > 0 &&
        velocity.dot(vector_of(contact.geom.normal)) < -contact.surface.bounce_vel) {
      contact.surface.mode |= dContactSoftCFM;
      contact.surface.soft_cfm = kHitSoftness;
    }
    dJointAttach(dJointCreateContact(world_, joints_, &contact), first, second);
  }
}

// What sleeps without a slot does not give way; it gets one as soon as something comes near.
void BodySolver::meet_sleeping() noexcept {
  if (slots_->asleep().size() == 0) return;
  each_acting([&](std::size_t i) {
    const RigidBody& body = body_at(i);
    if (body.geom == nullptr || !body.is_awake()) return;
    slots_->visit_asleep(i, box_of(body.geom), [&](std::uint32_t number) {
      collide(body.geom, slots_->kinds()[number].geom);
    });
  });
}

void BodySolver::note_contacts(dBodyID first, dBodyID second, int count) noexcept {
  const auto number = [](dBodyID body) {
    return reinterpret_cast<std::size_t>(dBodyGetData(body));
  };
  if (stands(first)) {
    islands_.add(number(second), count);
  } else if (stands(second)) {
    islands_.add(number(first), count);
  } else {
    islands_.join(number(first), number(second), count);
  }
}

// Of its middle, along an axis of S.
Walls BodySolver::walls_of(const RigidBody& body, int axis) const noexcept {
  dReal box[6];
  dGeomGetAABB(body.geom, box);
  const double at = dBodyGetPosition(body.id)[axis];
  const double middle = work_space_.position[axis], half = 0.5 * work_space_.size[axis];
  return {middle - half + (at - box[2 * axis]), middle + half - (box[2 * axis + 1] - at),
          work_space_.restitution};
}

// The solver moves a body by its new speed for all of the step, which keeps the energy of springs.
// One that nothing touches flies in closed form.
void BodySolver::fly_exactly(double dt) noexcept {
  each_acting([&](std::size_t i) {
    const RigidBody& body = body_at(i);
    if (!(body.mass > 0) || !body.is_awake()) return;
    const bool flies = body.flies && dBodyGetNumJoints(body.id) == 0;
    const double drag = body.drag / body.mass;
    if (!flies && !work_space_.is_set() && !(drag > 0)) return;
    const Vector3d from(body.before.at[0], body.before.at[1], body.before.at[2]);
    const Vector3d speed(body.before.velocity[0], body.before.velocity[1], body.before.velocity[2]);
    Vector3d at = vector_of(dBodyGetPosition(body.id)), v = vector_of(dBodyGetLinearVel(body.id));
    if (!flies) v *= std::exp(-drag * dt);
    for (int k = 0; k < 3; ++k) {
      Flight end{at[k], v[k]};
      if (flies) end = fly({from[k], speed[k]}, gravity_[k], drag, dt);
      if (work_space_.is_set()) {
        const Walls walls = walls_of(body, k);
        const double mean = drag > 0 ? (end.speed - speed[k]) / dt : gravity_[k];
        end = flies ? bounce({from[k], speed[k]}, mean, walls, dt) : stop(end, walls);
      }
      at[k] = end.place;
      v[k] = end.speed;
    }
    dBodySetPosition(body.id, at.x(), at.y(), at.z());
    dBodySetLinearVel(body.id, v.x(), v.y(), v.z());
  });
}

// A body that would be behind what it hits is put where its middle meets it, and the next step
// finds both in touch.
void BodySolver::catch_fast() noexcept {
  each_acting([&](std::size_t i) {
    const RigidBody& body = body_at(i);
    if (!(body.mass > 0)) return;
    const Vector3d from(body.before.at[0], body.before.at[1], body.before.at[2]);
    const Vector3d way = vector_of(dBodyGetPosition(body.id)) - from;
    const double length = way.norm();
    if (!(length > 0.5 * body.inner)) return;
    const double free = length_free(body, from, way / length, length);
    if (!(free < length)) return;
    const Vector3d at = from + std::max(0.0, free - 0.9 * body.inner) / length * way;
    dBodySetPosition(body.id, at.x(), at.y(), at.z());
  });
}

// How far the middle of a body gets before it meets anything else.
double BodySolver::length_free(const RigidBody& body, const Vector3d& from, const Vector3d& way,
                               double length) noexcept {
  dGeomRaySet(ray_, from.x(), from.y(), from.z(), way.x(), way.y(), way.z());
  dGeomRaySetLength(ray_, length);
  double free = length;
  const auto meet = [&](dGeomID geom) {
    dContactGeom hit;
    if (dCollide(ray_, geom, 1, &hit, sizeof hit) > 0) free = std::min(free, hit.depth);
  };
  for (int i = 0; i < dSpaceGetNumGeoms(geoms_->space()); ++i) {
    const dGeomID geom = dSpaceGetGeom(geoms_->space(), i);
    if (dGeomGetBody(geom) != body.id) meet(geom);
  }
  slots_->asleep().visit(box_of(ray_),
                         [&](std::uint32_t number) { meet(slots_->kinds()[number].geom); });
  return free;
}

double BodySolver::take_back(std::size_t slot, double energy) noexcept {
  RigidBody& body = body_at(slot);
  const double moving = body.kinetic_energy();
  const double taken = std::min(energy, moving);
  if (!(taken > 0)) return 0.0;
  body.slow(std::sqrt(1.0 - taken / moving));
  ledger_.energy -= taken;
  return taken;
}

// @param given work of all pushes in this step [J]
void BodySolver::take_out(double given) noexcept {
  const double most = ledger_.energy + given;
  const double excess = energy() - most;
  if (excess > 0) {
    double moving = 0.0;
    each_acting([&](std::size_t i) {
      if (is_carried(i)) return;
      const RigidBody& body = body_at(i);
      moving += body.kinetic_energy();
    });
    const double left = moving > excess ? std::sqrt(1.0 - excess / moving) : 0.0;
    each_acting([&](std::size_t i) {
      if (!is_carried(i)) body_at(i).slow(left);
    });
    ledger_.taken_out += std::min(excess, moving);
  }
  // What slow bodies were lifted by, out of one another, is due from the next motion.
  ledger_.energy = std::min(most, energy());
}

// Bodies that touch one another fall asleep together: one that does so alone would be woken by the
// others, and disturb them.
void BodySolver::rest(double dt) noexcept {
  std::array<double, BodySlots::kMost> still;  // [s], of islands
  still.fill(std::numeric_limits<double>::infinity());
  each_acting([&](std::size_t i) {
    RigidBody& body = body_at(i);
    if (!(body.mass > 0) || !body.is_awake()) return;
    const double speed = vector_of(dBodyGetLinearVel(body.id)).norm();
    if (speed > BodyWorld::kFastest) body.slow(BodyWorld::kFastest / speed);
    const bool is =
        speed < kStillSpeed && vector_of(dBodyGetAngularVel(body.id)).norm() < kStillTurn;
    body.still = is ? body.still + dt : 0.0;
    double& least = still[islands_.island_of(i)];
    least = std::min(least, body.still);
  });
  each_acting([&](std::size_t i) {
    RigidBody& body = body_at(i);
    if (!(body.mass > 0) || !body.is_awake()) return;
    if (still[islands_.island_of(i)] < pdu::to_seconds(BodyWorld::kSleep)) return;
    body.slow(0.0);
    dBodyDisable(body.id);
  });
}

}  // namespace reckon::haptics
