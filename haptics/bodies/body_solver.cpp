// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_solver.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdarg>
#include <mutex>

#include "reckon/haptics/bodies/body_mass.hpp"
#include "reckon/haptics/bodies/body_sleep.hpp"
#include "reckon/haptics/bodies/counted_work.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

// Rest depth of contacts [m], so that they persist from step to step.
constexpr double kRestDepth = 1e-5;
constexpr double kParting = 0.1;  // [m/s], greatest separation speed of penetrating bodies

// Set when the exact solver has found no solution, as in a pile of many contacts.
thread_local bool lost = false;
void note_lost(int, const char*, va_list) { lost = true; }

void start_ode() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetMessageHandler(note_lost);
  });
}

// Allocates ODE's data of this thread.
void know_thread() {
  thread_local const bool known = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  static_cast<void>(known);
}

}  // namespace

BodySolver::BodySolver(const EffectPlan& plan, const Vector3d& gravity, const WorkSpace& work_space)
    : gravity_(gravity) {
  start_ode();
  know_thread();
  world_ = dWorldCreate();
  geoms_.emplace(plan.objects());
  joints_.emplace(world_, energy_);
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
    motion_.emplace(*geoms_, *slots_, gravity, work_space);
    impacts_.emplace(*geoms_, *slots_, *joints_, *motion_);
  } catch (...) {
    destroy();
    throw;
  }
}

BodySolver::~BodySolver() { destroy(); }

void BodySolver::destroy() noexcept {
  slots_.reset();
  impacts_.reset();
  motion_.reset();
  joints_.reset();
  geoms_.reset();
  dWorldDestroy(world_);
}

bool BodySolver::awake(std::size_t slot) const noexcept {
  return acts(slot) ? body_at(slot).is_awake() : (parked_awake_ >> slot & 1) != 0;
}

double BodySolver::energy() const noexcept {
  double sum = slots_->asleep_energy();
  for (std::size_t i = 0; i < size(); ++i) sum += body_at(i).energy(gravity_);
  return sum;
}

void BodySolver::only(BodySet some) noexcept {
  some |= slots_->carried();
  if (some == only_) return;
  for (std::size_t i = 0; i < size(); ++i) {
    const BodySet one = BodySet{1} << i;
    const bool wanted = (some & one) != 0;
    const RigidBody& body = body_at(i);
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
  kept_ = tally_;
}

void BodySolver::restore() noexcept {
  each_acting([&](std::size_t i) { body_at(i).set(body_at(i).kept); });
  tally_ = kept_;
}

// Without other bodies, carried objects have no effect.
bool BodySolver::rests() const noexcept {
  if (std::popcount(slots_->carried()) == static_cast<int>(size())) return true;
  bool any = false;
  each_acting([&](std::size_t i) { any |= body_at(i).is_awake(); });
  return !any;
}

void BodySolver::step(double dt, std::span<BodyForce> forces) noexcept {
  if (forces.empty() && rests()) return;
  know_thread();
  energy_.begin(*slots_, only_, gravity_);
  apply(forces);
  each_acting([&](std::size_t i) {
    body_at(i).flies = vector_of(dBodyGetForce(body_at(i).id)).isZero(0.0);
  });
  joints_->begin();
  dSpaceCollide(geoms_->space(), &*joints_, [](void* joints, dGeomID a, dGeomID b) {
    static_cast<ContactJoints*>(joints)->meet(a, b);
  });
  meet_sleeping();
  time_speeds(dt);
  for (BodyForce& force : forces)
    force.work = 0.5 * dt * force.force.dot(body_at(force.slot).velocity_of(force.place));
  const BodySet alone = impacts_->find(budget_.has_impacts ? only_ : 0, dt);
  solve(alone, dt);
  joints_->book_driven(dt);
  book_lifted_ahead(dt);
  const BodySet solved = only_ & ~alone;
  motion_->fly_exactly(solved, dt);
  motion_->catch_fast(solved);
  impacts_->pass(dt, [&](BodySet bodies) { strike(bodies); });
  take_out(dt, forces);
  count_bodies();
  put_to_sleep(*slots_, only_, *joints_, dt);
  joints_->clear();
}

// The velocity of a pushed body is half a step older than its position (semi-implicit Euler); in
// flight both have the same time. So the change of velocity by gravity in half a step is subtracted
// when a push begins and added when it ends. Without this, a rebound from a hand would be too high.
void BodySolver::time_speeds(double dt) noexcept {
  each_acting([&](std::size_t i) {
    RigidBody& body = body_at(i);
    if (!(body.mass > 0) || !body.is_awake()) return;
    const bool is_held = dBodyGetNumJoints(body.id) > 0;
    const double lag = body.flies || is_held ? 0.0 : 0.5 * dt, change = body.lag - lag;
    body.lag = lag;
    if (is_held || change == 0.0) return;
    const double before = body.kinetic_energy();
    const Vector3d v = vector_of(dBodyGetLinearVel(body.id)) + change * gravity_;
    dBodySetLinearVel(body.id, v.x(), v.y(), v.z());
    energy_.give(i, body.kinetic_energy() - before);
  });
}

// Slowing a body after its motion does no work on it: a hand that it moved against pays for its own
// spring.
void BodySolver::take_out(double dt, std::span<BodyForce> forces) noexcept {
  const auto half = [&](const BodyForce& force) {
    return 0.5 * dt * force.force.dot(body_at(force.slot).velocity_of(force.place));
  };
  for (BodyForce& force : forces) {
    const Vector3d turned = vector_of(dBodyGetAngularVel(body_at(force.slot).id));
    force.made = half(force);
    energy_.press(force.slot, force.force.norm());
    energy_.give(force.slot,
                 force.work + force.made + dt * std::max(0.0, force.torque.dot(turned)));
  }
  tally_.taken_out += energy_.settle(*slots_, joints_->islands());
  for (BodyForce& force : forces) {
    const double more = std::max(0.0, half(force) - force.made);
    force.work += force.made + more;
    double& account = body_at(force.slot).account;
    if (account < 0) account = std::min(0.0, account + more);
  }
}

// A pushed body moves by its new velocity for the whole step. So it is lifted by half the change of
// its velocity more than the pushes have worked for, or less if it slows down.
void BodySolver::book_lifted_ahead(double dt) noexcept {
  each_acting([&](std::size_t i) {
    const RigidBody& body = body_at(i);
    const bool is_pushed =
        body.mass > 0 && !body.flies && body.is_awake() && dBodyGetNumJoints(body.id) == 0;
    if (!is_pushed) return;
    const Vector3d before(body.before.velocity[0], body.before.velocity[1],
                          body.before.velocity[2]);
    energy_.give(
        i, -0.5 * dt * body.mass * gravity_.dot(vector_of(dBodyGetLinearVel(body.id)) - before));
  });
}

// If the plan of the step has no exact solution for an island, or the exact solver fails, the
// iterative solver steps that island, and only that one; it always ends near the solution.
void BodySolver::solve(BodySet but, double dt) noexcept {
  each_acting([&](std::size_t i) { body_at(i).before = body_at(i).state(); });
  BodySet bodies = 0;
  each_acting([&](std::size_t i) { bodies |= BodySet{1} << i; });
  bodies &= ~(slots_->carried() | but);
  plan_.make(bodies, joints_->islands(), budget_.pushed, budget_.seconds);
  work_ += plan_.seconds();
  const BodySet iterated = plan_.iterated();
  if (!joints_->is_joined() && solve_exactly(bodies & ~iterated, dt) && iterated == 0) return;
  const bool is_all_undone = lost || joints_->is_joined();
  bool any = false;
  for (const PlannedIsland& island : plan_.islands()) {
    if (island.is_exact && (!is_all_undone || solve_exactly(island.bodies, dt))) continue;
    iterate(island, dt);
    any = true;
  }
  tally_.lost += any ? 1 : 0;
}

// @return whether a solution was found
bool BodySolver::solve_exactly(BodySet some, double dt) noexcept {
  lost = false;
  put_back(slots_->carried());  // it must move only once
  step_alone(some | slots_->carried(), [&] { host_.step(world_, dt); });
  if (lost) put_back(some);
  return !lost;
}

// Solves the impact of one or two bodies.
void BodySolver::strike(BodySet bodies) noexcept {
  lost = false;
  step_alone(bodies, [&] { host_.step(world_, Impacts::kInstant); });
  if (!lost) return;
  put_back(bodies);
  step_alone(bodies, [&] { host_.quick_step(world_, Impacts::kInstant); });
}

void BodySolver::iterate(const PlannedIsland& island, double dt) noexcept {
  dWorldSetQuickStepNumIterations(world_, IslandPlan::iterations_of(island));
  dRandSetSeed(1);  // for reproducible results
  put_back(island.bodies | slots_->carried());
  step_alone(island.bodies | slots_->carried(), [&] { host_.quick_step(world_, dt); });
}

void BodySolver::put_back(BodySet some) noexcept {
  slots_->each(some, [&](std::size_t i) { body_at(i).set(body_at(i).before); });
}

// Steps only `some`. Their contacts join them only to carried objects.
void BodySolver::step_alone(BodySet some, auto&& step) noexcept {
  BodySet off = 0;
  slots_->each(only_ & ~some, [&](std::size_t i) {
    if (body_at(i).is_awake()) off |= BodySet{1} << i;
  });
  if (off == 0) return step();
  const auto turn_joints = [&](auto&& turn) {
    slots_->each(only_ & ~some, [&](std::size_t i) {
      const dBodyID id = body_at(i).id;
      for (int k = 0; k < dBodyGetNumJoints(id); ++k) turn(dBodyGetJoint(id, k));
    });
  };
  turn_joints(dJointDisable);
  slots_->each(off, [&](std::size_t i) { dBodyDisable(body_at(i).id); });
  step();
  slots_->each(off, [&](std::size_t i) { dBodyEnable(body_at(i).id); });
  turn_joints(dJointEnable);
}

void BodySolver::count_bodies() noexcept {
  work_ += CountedWork::kStep + CountedWork::kDistance * impacts_->measured();
  each_acting([&](std::size_t i) {
    if (body_at(i).is_awake()) work_ += CountedWork::kBody * body_at(i).effort;
  });
}

void BodySolver::note_contacts() noexcept {
  each_acting([&](std::size_t i) { body_at(i).contacts = joints_->contacts_of(i); });
}

double BodySolver::work_of(BodySet some) const noexcept {
  double seconds = CountedWork::kStep, contacts = 0.0;
  slots_->each(some, [&](std::size_t i) {
    if (body_at(i).is_awake()) seconds += CountedWork::kBody * body_at(i).effort;
    contacts += body_at(i).contacts;
  });
  return seconds + IslandPlan::work_of(contacts);
}

void BodySolver::apply(std::span<BodyForce> forces) noexcept {
  for (const BodyForce& force : forces) {
    body_at(force.slot).push(force.place, force.force, force.torque);
  }
}

// Sleeping bodies without a slot are static here; they get a slot as soon as a body is near.
void BodySolver::meet_sleeping() noexcept {
  if (slots_->asleep().size() == 0) return;
  each_acting([&](std::size_t i) {
    const RigidBody& body = body_at(i);
    if (body.geom == nullptr || !body.is_awake()) return;
    slots_->visit_asleep(i, box_of(body.geom), [&](std::uint32_t number) {
      joints_->meet(body.geom, slots_->kinds()[number].geom);
    });
  });
}

double BodySolver::take_back(std::size_t slot, double energy) noexcept {
  RigidBody& body = body_at(slot);
  const double moving = body.kinetic_energy();
  const double taken = std::min(energy, moving);
  if (!(taken > 0)) return 0.0;
  body.slow(std::sqrt(1.0 - taken / moving));
  return taken;
}

}  // namespace reckon::haptics
