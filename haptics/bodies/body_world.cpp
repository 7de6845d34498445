// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kLongestStep = 1e-3;     // [s]
constexpr double kLongestGap = 0.1;       // [s]
constexpr int kContacts = 8;              // of a pair, at most
constexpr std::size_t kMostPushes = 256;  // 8 hands of 8 probes, each held by 3 bodies at most
// Depth at which contacts rest [m], so that they last from step to step.
constexpr double kRestDepth = 1e-5;
constexpr double kParting = 0.1;       // [m/s], at most, of bodies that are in one another
constexpr double kBounceSpeed = 0.01;  // [m/s]; slower hits do not bounce
constexpr double kSlipSpeed = 1e-4;    // [m/s]; faster ones rub along their way
constexpr double kStillSpeed = 1e-3;   // [m/s]
constexpr double kStillTurn = 0.02;    // [rad/s]

Vector3d vector(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

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

}  // namespace

class BodyWorld::Engine {
 public:
  Engine(const EffectPlan& plan, const Vector3d& gravity) : gravity_(gravity) {
    start_ode();
    know_thread();
    world_ = dWorldCreate();
    geoms_.emplace();
    joints_ = dJointGroupCreate(0);
    ray_ = dCreateRay(nullptr, 1.0);
    keep_within_thread(world_);
    dWorldSetGravity(world_, gravity.x(), gravity.y(), gravity.z());
    dWorldSetERP(world_, 0.2);
    dWorldSetQuickStepNumIterations(world_, 60);
    dWorldSetCFM(world_, 1e-7);
    dWorldSetContactSurfaceLayer(world_, kRestDepth);
    dWorldSetContactMaxCorrectingVel(world_, kParting);
    // Geoms point to what they are made of, and a step allocates nothing.
    matters_.reserve(plan.objects().size());
    pushes_.reserve(kMostPushes);
    works_.reserve(kMostPushes);
    before_.reserve(kMostPushes);
    try {
      for (std::uint32_t i = 0; i < plan.objects().size(); ++i) add(plan.objects()[i], i);
    } catch (...) {
      destroy();
      throw;
    }
    read_states();
    energy_ = energy();
  }
  ~Engine() { destroy(); }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  bool advance_to(nanoseconds now) noexcept {
    if (!std::exchange(started_, true)) time_ = now;
    const double gap = pdu::to_seconds(now - time_);
    if (!(gap > 0)) return false;
    time_ = now;
    works_.assign(pushes_.size(), 0.0);
    const double whole = std::min(gap, kLongestGap);
    const double steps = std::ceil(whole / kLongestStep - 1e-9);
    for (int i = 0; i < static_cast<int>(steps); ++i) step(whole / steps);
    pushes_.clear();
    read_states();
    return true;
  }

  std::size_t push(std::size_t body, const Vector3d& point, const Vector3d& force) noexcept {
    if (body >= bodies_.size() || pushes_.size() >= kMostPushes || !force.allFinite())
      return kNoPush;
    const dReal* at = dBodyGetPosition(bodies_[body].id);
    const Quaterniond turned = orientation(body);
    pushes_.push_back({body, turned.conjugate() * (point - vector(at)), force});
    return pushes_.size() - 1;
  }
  [[nodiscard]] double work(std::size_t push) const noexcept {
    return push < works_.size() ? works_[push] : 0.0;
  }
  [[nodiscard]] std::span<const BodyState> states() const noexcept { return states_; }
  [[nodiscard]] double taken_out() const noexcept { return taken_out_; }
  [[nodiscard]] std::uint64_t approximated() const noexcept { return lost_; }

  [[nodiscard]] double energy() const noexcept {
    double sum = 0.0;
    for (const Body& body : bodies_) {
      const Vector3d v = vector(dBodyGetLinearVel(body.id));
      sum += 0.5 * body.mass * v.squaredNorm() + turning_energy(body) -
             body.mass * gravity_.dot(vector(dBodyGetPosition(body.id)) - body.start);
    }
    return sum;
  }

 private:
  struct Body {
    dBodyID id = nullptr;
    std::uint32_t object = 0;
    double mass = 0.0;
    double inner = 0.0;  // [m], radius of the ball within it
    Vector3d start = Vector3d::Zero();
    double still = 0.0;  // [s]
    bool flies = true;   // nothing pushes it in this step but its weight
    // Before a step.
    std::array<dReal, 3> at{}, velocity{}, turn_rate{}, force{}, torque{};
    std::array<dReal, 4> turned{};

    void keep() noexcept {
      std::copy_n(dBodyGetPosition(id), 3, at.begin());
      std::copy_n(dBodyGetQuaternion(id), 4, turned.begin());
      std::copy_n(dBodyGetLinearVel(id), 3, velocity.begin());
      std::copy_n(dBodyGetAngularVel(id), 3, turn_rate.begin());
      std::copy_n(dBodyGetForce(id), 3, force.begin());
      std::copy_n(dBodyGetTorque(id), 3, torque.begin());
    }
    void restore() const noexcept {
      const dQuaternion q{turned[0], turned[1], turned[2], turned[3]};
      dBodySetPosition(id, at[0], at[1], at[2]);
      dBodySetQuaternion(id, q);
      dBodySetLinearVel(id, velocity[0], velocity[1], velocity[2]);
      dBodySetAngularVel(id, turn_rate[0], turn_rate[1], turn_rate[2]);
      dBodySetForce(id, force[0], force[1], force[2]);
      dBodySetTorque(id, torque[0], torque[1], torque[2]);
    }
  };
  struct Push {
    std::size_t body = 0;
    Vector3d place = Vector3d::Zero();  // in its axes, from its middle
    Vector3d force = Vector3d::Zero();
  };

  void destroy() noexcept {
    dGeomDestroy(ray_);
    dJointGroupDestroy(joints_);
    geoms_.reset();
    dWorldDestroy(world_);
  }

  void add(const PlannedObject& object, std::uint32_t number) {
    const bool moves = object.moves();
    if (moves && bodies_.size() >= kMostBodies) {
      refuse_body(object, "a scene moves at most " + std::to_string(kMostBodies) +
                              " bodies: take the mass of some out");
    }
    const dGeomID geom = geoms_->add(object);
    if (geom == nullptr) return;
    matters_.push_back(object.matter);
    dGeomSetData(geom, &matters_.back());
    if (!moves) return;
    Body& body = bodies_.emplace_back();
    body.id = dBodyCreate(world_);
    body.object = number;
    body.mass = object.matter.mass;
    body.start = object.position;
    dMass mass;
    if (std::holds_alternative<Ball>(object.shape)) {
      body.inner = dGeomSphereGetRadius(geom);
      dMassSetSphereTotal(&mass, body.mass, dGeomSphereGetRadius(geom));
    } else {
      dVector3 size;
      dGeomBoxGetLengths(geom, size);
      body.inner = 0.5 * std::min({size[0], size[1], size[2]});
      dMassSetBoxTotal(&mass, body.mass, size[0], size[1], size[2]);
    }
    dBodySetMass(body.id, &mass);
    dGeomSetBody(geom, body.id);
    const Quaterniond q(object.orientation);
    const dQuaternion turned{q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(body.id, object.position.x(), object.position.y(), object.position.z());
    dBodySetQuaternion(body.id, turned);
    dBodySetMaxAngularSpeed(body.id, kFastestTurn);
    states_.emplace_back().object = number;
  }

  [[nodiscard]] Quaterniond orientation(std::size_t body) const noexcept {
    const dReal* q = dBodyGetQuaternion(bodies_[body].id);
    return {q[0], q[1], q[2], q[3]};
  }
  [[nodiscard]] static double turning_energy(const Body& body) noexcept {
    const dReal* q = dBodyGetQuaternion(body.id);
    const Vector3d rate =
        Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * vector(dBodyGetAngularVel(body.id));
    dMass mass;
    dBodyGetMass(body.id, &mass);
    return 0.5 * (mass.I[0] * rate.x() * rate.x() + mass.I[5] * rate.y() * rate.y() +
                  mass.I[10] * rate.z() * rate.z());
  }

  [[nodiscard]] bool rests() const noexcept {
    return pushes_.empty() &&
           std::ranges::none_of(bodies_, [](const Body& body) { return dBodyIsEnabled(body.id); });
  }

  void step(double dt) noexcept {
    if (rests()) return;
    know_thread();
    apply_pushes();
    for (Body& body : bodies_) body.flies = vector(dBodyGetForce(body.id)).isZero(0.0);
    before_.clear();
    for (const Push& push : pushes_) before_.push_back(velocity_of(push));
    dSpaceCollide(geoms_->space(), this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<Engine*>(self)->collide(a, b);
    });
    solve(dt);
    fly_exactly(dt);
    catch_fast();
    dJointGroupEmpty(joints_);
    double given = 0.0;
    for (std::size_t i = 0; i < pushes_.size(); ++i) {
      const double work = 0.5 * dt * pushes_[i].force.dot(velocity_of(pushes_[i]) + before_[i]);
      works_[i] += work;
      given += work;
    }
    take_out(given);
    rest(dt);
    energy_ = std::min(energy_, energy());  // what falls asleep or is too fast gives some up
  }

  // Where the exact solver is lost, the step is taken again by one that always ends near the
  // answer.
  void solve(double dt) noexcept {
    for (Body& body : bodies_) body.keep();
    lost = false;
    dWorldStep(world_, dt);
    if (!lost) return;
    ++lost_;
    for (Body& body : bodies_) body.restore();
    dRandSetSeed(1);  // so that it is the same twice
    dWorldQuickStep(world_, dt);
  }

  void apply_pushes() noexcept {
    for (const Push& push : pushes_) {
      const dBodyID id = bodies_[push.body].id;
      if (push.force.squaredNorm() > 0 && !dBodyIsEnabled(id)) {
        dBodyEnable(id);
        bodies_[push.body].still = 0.0;
      }
      const Vector3d at = place(push);
      dBodyAddForceAtPos(id, push.force.x(), push.force.y(), push.force.z(), at.x(), at.y(),
                         at.z());
    }
  }

  [[nodiscard]] Vector3d place(const Push& push) const noexcept {
    return vector(dBodyGetPosition(bodies_[push.body].id)) + orientation(push.body) * push.place;
  }

  [[nodiscard]] Vector3d velocity_of(const Push& push) const noexcept {
    const dBodyID id = bodies_[push.body].id;
    return vector(dBodyGetLinearVel(id)) +
           vector(dBodyGetAngularVel(id)).cross(orientation(push.body) * push.place);
  }

  void collide(dGeomID a, dGeomID b) noexcept {
    const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
    const auto sleeps = [](dBodyID body) { return body == nullptr || !dBodyIsEnabled(body); };
    if (sleeps(first) && sleeps(second)) return;
    std::array<dContact, kContacts> contacts{};
    const int count = dCollide(a, b, kContacts, &contacts[0].geom, sizeof(dContact));
    if (count == 0) return;
    const auto* one = static_cast<const Matter*>(dGeomGetData(a));
    const auto* other = static_cast<const Matter*>(dGeomGetData(b));
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1 | dContactBounce;
      contact.surface.mu = std::sqrt(one->friction * other->friction);
      contact.surface.bounce = std::max(one->restitution, other->restitution);
      contact.surface.bounce_vel = kBounceSpeed;
      rub_along(contact, first, second);
      dJointAttach(dJointCreateContact(world_, joints_, &contact), first, second);
    }
  }

  // Friction is bounded along two axes: where a contact slips, one of them is its way.
  static void rub_along(dContact& contact, dBodyID first, dBodyID second) noexcept {
    const Vector3d at = vector(contact.geom.pos), normal = vector(contact.geom.normal);
    const auto velocity = [&](dBodyID body) -> Vector3d {
      if (body == nullptr) return Vector3d::Zero();
      return vector(dBodyGetLinearVel(body)) +
             vector(dBodyGetAngularVel(body)).cross(at - vector(dBodyGetPosition(body)));
    };
    Vector3d slip = velocity(first) - velocity(second);
    slip -= normal.dot(slip) * normal;
    const double speed = slip.norm();
    if (!(speed > kSlipSpeed)) return;
    contact.surface.mode |= dContactFDir1;
    for (int i = 0; i < 3; ++i) contact.fdir1[i] = slip[i] / speed;
  }

  // The solver moves a body by its new speed for all of the step, which keeps the energy of
  // springs. One that nothing touches flies by the mean of both.
  void fly_exactly(double dt) noexcept {
    for (const Body& body : bodies_) {
      if (!body.flies || !dBodyIsEnabled(body.id) || dBodyGetNumJoints(body.id) > 0) continue;
      const Vector3d at = vector(dBodyGetPosition(body.id)) - 0.5 * dt * dt * gravity_;
      dBodySetPosition(body.id, at.x(), at.y(), at.z());
    }
  }

  // A body that would be behind what it hits is put where its middle meets it, and the next step
  // finds both in touch.
  void catch_fast() noexcept {
    for (const Body& body : bodies_) {
      const Vector3d from(body.at[0], body.at[1], body.at[2]);
      const Vector3d way = vector(dBodyGetPosition(body.id)) - from;
      const double length = way.norm();
      if (!(length > 0.5 * body.inner)) continue;
      const double free = length_free(body, from, way / length, length);
      if (!(free < length)) continue;
      const Vector3d at = from + std::max(0.0, free - 0.9 * body.inner) / length * way;
      dBodySetPosition(body.id, at.x(), at.y(), at.z());
    }
  }

  // How far the middle of a body gets before it meets anything else.
  [[nodiscard]] double length_free(const Body& body, const Vector3d& from, const Vector3d& way,
                                   double length) noexcept {
    dGeomRaySet(ray_, from.x(), from.y(), from.z(), way.x(), way.y(), way.z());
    dGeomRaySetLength(ray_, length);
    double free = length;
    for (int i = 0; i < dSpaceGetNumGeoms(geoms_->space()); ++i) {
      const dGeomID geom = dSpaceGetGeom(geoms_->space(), i);
      if (dGeomGetBody(geom) == body.id) continue;
      dContactGeom hit;
      if (dCollide(ray_, geom, 1, &hit, sizeof hit) > 0) free = std::min(free, hit.depth);
    }
    return free;
  }

  // @param given work of all pushes in this step [J]
  void take_out(double given) noexcept {
    const double most = energy_ + given;
    const double excess = energy() - most;
    if (excess > 0) {
      double moving = 0.0;
      for (const Body& body : bodies_)
        moving += 0.5 * body.mass * vector(dBodyGetLinearVel(body.id)).squaredNorm() +
                  turning_energy(body);
      const double left = moving > excess ? std::sqrt(1.0 - excess / moving) : 0.0;
      for (const Body& body : bodies_) slow(body.id, left);
      taken_out_ += std::min(excess, moving);
    }
    // What slow bodies were lifted by, out of one another, is due from the next motion.
    energy_ = std::min(most, energy());
  }

  static void slow(dBodyID body, double factor) noexcept {
    const Vector3d v = factor * vector(dBodyGetLinearVel(body));
    const Vector3d w = factor * vector(dBodyGetAngularVel(body));
    dBodySetLinearVel(body, v.x(), v.y(), v.z());
    dBodySetAngularVel(body, w.x(), w.y(), w.z());
  }

  void rest(double dt) noexcept {
    for (Body& body : bodies_) {
      if (!dBodyIsEnabled(body.id)) continue;
      const double speed = vector(dBodyGetLinearVel(body.id)).norm();
      if (speed > kFastest) slow(body.id, kFastest / speed);
      const bool is =
          speed < kStillSpeed && vector(dBodyGetAngularVel(body.id)).norm() < kStillTurn;
      body.still = is ? body.still + dt : 0.0;
      if (body.still < pdu::to_seconds(kSleep)) continue;
      slow(body.id, 0.0);
      dBodyDisable(body.id);
    }
  }

  void read_states() noexcept {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      BodyState& state = states_[i];
      const dBodyID id = bodies_[i].id;
      state.awake = dBodyIsEnabled(id) != 0;
      state.position = vector(dBodyGetPosition(id));
      state.orientation = orientation(i);
      state.velocity = vector(dBodyGetLinearVel(id));
      state.turn_rate = vector(dBodyGetAngularVel(id));
    }
  }

  dWorldID world_ = nullptr;
  std::optional<BodyGeoms> geoms_;  // begins when ODE has
  dJointGroupID joints_ = nullptr;
  dGeomID ray_ = nullptr;  // in no space
  Vector3d gravity_;
  std::vector<Matter> matters_;  // of geoms
  std::vector<Body> bodies_;
  std::vector<BodyState> states_;
  std::vector<Push> pushes_;
  std::vector<Vector3d> before_;  // of the pushes, [m/s]
  std::vector<double> works_;
  bool started_ = false;
  nanoseconds time_{0};
  double energy_ = 0.0;
  double taken_out_ = 0.0;
  std::uint64_t lost_ = 0;
};

BodyWorld::BodyWorld(const EffectPlan& plan, const Vector3d& gravity)
    : engine_(std::make_unique<Engine>(plan, gravity)) {
  publish();
}
BodyWorld::~BodyWorld() = default;

void BodyWorld::advance_to(nanoseconds now) noexcept {
  if (engine_->advance_to(now)) publish();
}

void BodyWorld::publish() noexcept {
  BodyStates& out = published_.write_slot();
  const std::span<const BodyState> states = engine_->states();
  out.count = states.size();
  std::ranges::copy(states, out.bodies.begin());
  published_.publish();
}

std::shared_ptr<BodyWorld> make_bodies(const EffectPlan& plan, const Vector3d& gravity) {
  return plan.has_bodies() ? std::make_shared<BodyWorld>(plan, gravity) : nullptr;
}

std::size_t BodyWorld::push(std::size_t body, const Vector3d& point,
                            const Vector3d& force) noexcept {
  return engine_->push(body, point, force);
}
double BodyWorld::work(std::size_t push) const noexcept { return engine_->work(push); }
std::span<const BodyState> BodyWorld::states() const noexcept { return engine_->states(); }
double BodyWorld::energy() const noexcept { return engine_->energy(); }
double BodyWorld::taken_out() const noexcept { return engine_->taken_out(); }
std::uint64_t BodyWorld::approximated() const noexcept { return engine_->approximated(); }

}  // namespace reckon::haptics
