// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/contact_solver.hpp"

#include <algorithm>
#include <numeric>

#include "reckon/haptics/contact/contact_shares.hpp"
#include "reckon/haptics/contact/free_place.hpp"
#include "reckon/haptics/queries/pair_query.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

// Far beyond any scene, but near enough that its square does not overflow.
constexpr double kFarthest = 1e9;
constexpr double kBeyond = 0.01;     // [m]
constexpr double kPassedFor = 0.05;  // [s]

bool usable(const Vector3d& device) {
  return device.allFinite() && device.cwiseAbs().maxCoeff() <= kFarthest;
}

// Friction cone that holds the contact point; null for a smooth surface.
FrictionCone* cone_of(PlannedEffects& effects) {
  FrictionCone* cone = nullptr;
  effects.for_each([&]<class Effect>(Effect& effect) {
    if constexpr (HoldsContactPoint<Effect>) {
      if (hooks_of(effect).holds) cone = &effect.cone();
    }
  });
  return cone;
}

bool has_follower(const PlannedEffects& effects) {
  bool has = false;
  effects.for_each([&](const auto& effect) { has |= hooks_of(effect).follows; });
  return has;
}

// The objects whose planes carry load. A walk that needs more moves than one step has may end
// without load. Then the object of a plane that it met holds the point, or else `other`.
std::size_t holders(const ContactWalk<ObjectObstacles>& walk, std::uint32_t other,
                    const Vector3d& way, ContactShares& shares) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < walk.solution.active_count; ++i) {
    if (!(walk.solution.loads[i] > 0.0)) continue;
    const ConstraintPlane& plane = walk.planes[walk.solution.active[i]];
    std::size_t place = 0;
    while (place < count && shares[place].object != plane.object) ++place;
    if (place == count) shares[count++].object = plane.object;
    shares[place].push += walk.solution.loads[i] * plane.normal;
    if (walk.solution.loads[i] > shares[place].load) {
      shares[place].load = walk.solution.loads[i];
      shares[place].triangle = plane.triangle;
    }
  }
  if (count > 0) return count;
  shares[0].object = walk.planes.size() > 0 ? walk.planes[0].object : other;
  shares[0].triangle = walk.planes.size() > 0 ? walk.planes[0].triangle : 0;
  shares[0].push = way.isZero(0.0) && walk.planes.size() > 0 ? walk.planes[0].normal : way;
  return 1;
}

// Whether a point is outside of a solid [m, S].
bool is_outside(const QueryShape& solid, const PlannedObject& now, const Vector3d& p) {
  static const QueryShape point = QueryShape::sphere(0.0);
  return measure_pair(point, {p}, solid, {now.position, now.orientation}).distance.least > 0.0;
}

// What effects are given of an object that is touched.
ContactedObject seen_of(const PlannedObject& object, const ObjectContact& contact, bool began,
                        double gain) {
  ContactedObject seen;
  seen.place = object.place_of(contact.scp);
  seen.axes = object.orientation;
  seen.triangle = contact.triangle;
  seen.patch = contact.patch;
  seen.began = began;
  seen.gain = gain;
  return seen;
}

}  // namespace

ContactSolver::ContactSolver(const EffectPlan& plan, double radius, double patch_cap)
    : plan_(plan), radius_(radius), patch_cap_(patch_cap) {
  const std::size_t count = plan.objects().size();
  contacts_.resize(count);
  near_.reserve(count);
  reached_.reserve(count);
  touched_.reserve(count);
  noted_.resize(count);
  states_.reserve(count);
  moving_.reserve(
      static_cast<std::size_t>(std::ranges::count_if(plan.objects(), &PlannedObject::moves)));
  placed_.reserve(moving_.capacity());
  moving_of_.assign(count, kNobody);
  for (const PlannedObject& object : plan.objects()) {
    objects_.push_back(&object);
    if (object.moves()) {
      moving_of_[objects_.size() - 1] = static_cast<std::uint32_t>(moving_.size());
      const ObjectMotion start{object.position, Eigen::Quaterniond(object.orientation)};
      moving_.push_back({static_cast<std::uint32_t>(objects_.size() - 1), object, start, start, 0,
                         Vector3d::Zero(), QueryShape(object.shape)});
      objects_.back() = &moving_.back().now;
    }
    states_.push_back({SurfaceContactPoint(radius), object.effects});
    states_.back().follows = has_follower(object.effects);
    any_follows_ |= states_.back().follows;
    cones_.push_back(cone_of(states_.back().effects));
  }
}

ContactResult ContactSolver::reset(const Vector3d& device) noexcept {
  if (!usable(device)) return nothing();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    contacts_[i] = {};
    states_[i].effects = objects_[i]->effects;
    states_[i].touched_at = 0;
    states_[i].hidden = 0.0;
  }
  near_.resize(states_.size());
  std::iota(near_.begin(), near_.end(), 0u);
  touched_.clear();
  place_outside(device);
  settle(device);
  last_device_ = device;
  started_ = true;
  return sum(device);
}

void ContactSolver::place(std::uint32_t body, const ObjectMotion& motion,
                          const ObjectMotion& before) noexcept {
  MovingObject& moving = moving_[body];
  if (moving.placed == round_) return;
  forget_placed(round_);
  placed_.push_back(body);
  const bool was_met = moving.placed + 1 == round_;
  moving.placed = round_;
  moving.pushed = contacts_[moving.object].force;
  moving.before = was_met ? moving.motion : before;
  moving.motion = motion;
  // It stands where it stood.
  if (was_met && !moving.is_moved()) return;
  moving.now.place(motion.position, motion.orientation.toRotationMatrix());
}

// Those of rounds before.
void ContactSolver::forget_placed(std::uint64_t round) noexcept {
  if (!placed_.empty() && moving_[placed_.front()].placed != round) placed_.clear();
}

// The contact point goes on with the body that holds it most. A body that comes from elsewhere
// pushes it.
void ContactSolver::carry() noexcept {
  const MovingObject* holder = nullptr;
  for (const std::uint32_t body : placed_) {
    const MovingObject& moving = moving_[body];
    const ObjectContact& contact = contacts_[moving.object];
    if (!contact.in_contact) continue;
    if (holder == nullptr || contact.depth > contacts_[holder->object].depth) holder = &moving;
  }
  if (holder != nullptr) scp_ = holder->now.to_scene(holder->before_of(scp_));
  for (const std::uint32_t body : placed_) {
    const MovingObject& moving = moving_[body];
    if (&moving == holder || !moving.is_moved()) continue;
    SurfaceContactPoint point(radius_);
    point.set_free(moving.before_of(scp_));
    point.update(moving.now.shape, moving.now.to_object(scp_), nullptr);
    if (!point.in_contact()) continue;
    scp_ = moving.now.to_scene(point.scp());
    if (alone_ != moving.object) alone_ = kNobody;
  }
}

ContactResult ContactSolver::step(const Vector3d& device, double dt) noexcept {
  forget_placed(round_++);
  if (!usable(device)) return nothing();
  if (!started_) return reset(device);
  if (any_follows_) follow_place(dt);
  if (!placed_.empty()) carry();
  find_near(device);
  settle(device);
  lost_ = 0.0;
  if (!placed_.empty()) let_through(device, dt);
  for (const std::uint32_t i : near_) states_[i].started_inside &= contacts_[i].in_contact;
  last_device_ = device;
  return sum(device);
}

// A body has passed the hand when the device has been outside of it, far beyond the stretch of its
// springs, for kPassedFor. The SCP then goes to the device as if the body were not there.
void ContactSolver::let_through(const Vector3d& device, double dt) noexcept {
  for (const std::uint32_t body : placed_) {
    MovingObject& moving = moving_[body];
    const double most = kBeyond + strongest_ / std::min(stiffness_of(moving.object), patch_cap_);
    const bool is_beyond = contacts_[moving.object].in_contact && (device - scp_).norm() > most &&
                           is_outside(moving.solid, moving.now, device);
    moving.beyond = is_beyond ? moving.beyond + dt : 0.0;
    if (!(moving.beyond > kPassedFor)) continue;
    lost_ += contacts_[moving.object].stored_energy;
    ++passed_;
    moving.beyond = 0.0;
    left_out_ = moving.object;
    settle(device);
    left_out_ = kNobody;
  }
}

// An object that was touched just now begins at its place, without sliding.
void ContactSolver::follow_place(double dt) noexcept {
  for (const std::uint32_t i : touched_) {
    ObjectState& state = states_[i];
    if (!state.follows) continue;
    const Vector3d place = objects_[i]->place_of(scp_);
    const bool slid = cones_[i]->sliding();
    const double pressed = std::max(contacts_[i].force.dot(contacts_[i].normal), 0.0);
    const double slip = slid ? (place - state.place).norm() / dt : 0.0;
    const double depth = std::max((scp_ - last_device_).dot(contacts_[i].normal), 0.0);
    const SlidingPlace now{place, slip, dt, pressed, state.began, depth};
    state.place = place;
    state.effects.for_each([&]<class Effect>(Effect& effect) {
      if constexpr (FollowsPlace<Effect>) effect.follow(now);
    });
  }
}

// The SCP never moves farther from the device than it is. A touched object may be left on a path
// that no longer meets its box, and must be notified.
void ContactSolver::find_near(const Vector3d& device) noexcept {
  ++step_;
  near_.clear();
  const auto note = [this](std::uint32_t index) {
    if (noted_[index] == step_) return;
    noted_[index] = step_;
    near_.push_back(index);
  };
  const Vector3d reach = Vector3d::Constant((device - scp_).norm() + radius_);
  plan_.visit_near({device - reach, device + reach}, note);
  for (const std::uint32_t body : placed_) note(moving_[body].object);
  for (const std::uint32_t index : touched_) note(index);
  std::sort(near_.begin(), near_.end());
}

bool ContactSolver::within_reach(std::uint32_t index, const Vector3d& device) const noexcept {
  if (index == left_out_) return false;
  const PlannedObject& object = *objects_[index];
  const double reach = (device - scp_).norm() + radius_ + 2.0 * clearance_of(object.shape);
  return distance_below(object.shape, object.to_object(device)) <= reach;
}

void ContactSolver::place_outside(const Vector3d& device) noexcept {
  scp_ = device;
  alone_ = kNobody;
  std::uint32_t moved = kNobody;
  for (std::uint32_t i = 0; i < states_.size(); ++i) {
    const PlannedObject& object = *objects_[i];
    const Vector3d local = object.to_object(device);
    states_[i].started_inside = states_[i].point.reset(object.shape, local);
    if (states_[i].point.scp() != local) moved = i;
  }
  if (moved == kNobody) return;
  Vector3d p = objects_[moved]->to_scene(states_[moved].point.scp());
  const FreePlace free(plan_, objects_, radius_);
  if (free.overlapped(p) == FreePlace::kNobody) {
    alone_ = moved;
  } else if (!free.push_out(p)) {
    p = free.search(device);
  }
  scp_ = p;
}

void ContactSolver::settle(const Vector3d& device) noexcept {
  reached_.clear();
  for (const std::uint32_t i : near_) {
    if (within_reach(i, device)) reached_.push_back(i);
    contacts_[i] = {};
    contacts_[i].scp = device;
  }
  if (reached_.empty()) {
    scp_ = device;
    alone_ = kNobody;
  } else if (reached_.size() == 1) {
    settle_on_one(reached_.front(), device);
  } else {
    settle_among(device);
  }
  // An object that was left no longer slides, and is whole again.
  for (const std::uint32_t i : touched_) {
    if (contacts_[i].in_contact) continue;
    if (cones_[i] != nullptr) cones_[i]->set_sliding(false);
    states_[i].hidden = 0.0;
  }
}

void ContactSolver::settle_on_one(std::uint32_t index, const Vector3d& device) noexcept {
  const PlannedObject& object = *objects_[index];
  SurfaceContactPoint& point = states_[index].point;
  if (alone_ != index) point.set_free(object.to_object(scp_));
  const Vector3d local = object.to_object(device);
  point.update(object.shape, local, cones_[index]);
  alone_ = point.in_contact() ? index : kNobody;
  scp_ = point.in_contact() ? object.to_scene(point.scp()) : device;
  if (!point.in_contact()) return;
  contacts_[index].normal = object.orientation * point.normal();
  contacts_[index].scp = scp_;
  note_touch(index, point.triangle());
  feel(index, point.scp(), local);
}

void ContactSolver::settle_among(const Vector3d& device) noexcept {
  bool sliding = false;
  for (const std::uint32_t i : touched_) sliding |= cones_[i] != nullptr && cones_[i]->sliding();
  const ObjectObstacles obstacles{objects_, cones_, reached_, radius_, scp_};
  const Vector3d goal = device - scp_;
  ContactWalk<ObjectObstacles> walk{obstacles, goal, Vector3d::Zero(), sliding};
  alone_ = kNobody;
  if (walk.run()) {
    scp_ = device;
    return;
  }
  scp_ += walk.p;
  ContactShares shares;
  const std::size_t count = holders(walk, reached_.front(), scp_ - device, shares);
  share_way(scp_ - device, std::span(shares).first(count));
  for (const ContactShare& share : std::span(shares).first(count)) {
    const PlannedObject& object = *objects_[share.object];
    contacts_[share.object].normal = share.push.normalized();
    contacts_[share.object].scp = scp_;
    const Vector3d local = object.to_object(device);
    note_touch(share.object, share.triangle);
    feel(share.object, local + object.orientation.transpose() * share.way, local);
    FrictionCone* cone = cones_[share.object];
    if (cone != nullptr) cone->set_sliding(walk.sliding && !walk.p.isZero(0.0));
  }
}

SurfaceFeel ContactSolver::goal_of(std::uint32_t index) const noexcept {
  SurfaceFeel goal = objects_[index]->patches->feel_of(contacts_[index].patch);
  goal.surface.stiffness = std::min(goal.surface.stiffness, patch_cap_);
  return goal;
}

void ContactSolver::apply(std::uint32_t index, const SurfaceFeel& feel) noexcept {
  PlannedEffects& effects = states_[index].effects;
  effects.find<SpringDamper>()->adjust(feel.surface);
  if (auto* friction = effects.find<StickSlipFriction>()) friction->adjust(feel.friction);
}

// A new contact begins with the patch below it. An existing one changes to it gradually.
void ContactSolver::note_touch(std::uint32_t index, std::uint32_t triangle) noexcept {
  const PlannedObject& object = *objects_[index];
  ObjectState& state = states_[index];
  state.began = state.touched_at == 0 || state.touched_at + 1 < step_;
  state.touched_at = step_;
  if (object.is_mesh()) contacts_[index].triangle = triangle;
  if (object.patches == nullptr) return;
  contacts_[index].patch = object.patches->of_triangle[triangle];
  if (!state.began) return;
  state.blend.begin(goal_of(index));
  apply(index, state.blend.now());
}

ContactResult ContactSolver::follow_patches(double dt, double energy) noexcept {
  patch_share_ = 1.0;
  for (const std::uint32_t i : touched_) {
    if (objects_[i]->patches == nullptr) continue;
    PatchBlend& blend = states_[i].blend;
    energy -= blend.follow(goal_of(i), contacts_[i].depth, dt, std::max(0.0, energy));
    patch_share_ = std::min(patch_share_, blend.share());
    apply(i, blend.now());
    feel(i, states_[i].held_at, objects_[i]->to_object(last_device_));
  }
  return sum(last_device_);
}

ContactResult ContactSolver::hide(double share) noexcept {
  for (const std::uint32_t i : touched_) {
    states_[i].hidden += (1.0 - share) * contacts_[i].depth;
    feel(i, states_[i].held_at, objects_[i]->to_object(last_device_));
  }
  return sum(last_device_);
}

double ContactSolver::hidden() const noexcept {
  double most = 0.0;
  for (const std::uint32_t i : touched_) most = std::max(most, states_[i].hidden);
  return most;
}

double ContactSolver::shown_depth() const noexcept {
  double least = 1.0;
  for (const std::uint32_t i : touched_) {
    const double hidden = states_[i].hidden;
    if (hidden > 0) least = std::min(least, contacts_[i].depth / (contacts_[i].depth + hidden));
  }
  return least;
}

bool ContactSolver::on_patches() const noexcept {
  return std::ranges::any_of(
      touched_, [&](std::uint32_t index) { return objects_[index]->patches != nullptr; });
}

double ContactSolver::stiffness_of(std::uint32_t index) const noexcept {
  double sum = 0.0;
  states_[index].effects.for_each_spring([&](const auto& effect) { sum += effect.stiffness(); });
  return sum;
}

// Forces of one object's springs, in its axes, for a contact with known place and normal.
void ContactSolver::feel(std::uint32_t index, const Vector3d& scp,
                         const Vector3d& device) noexcept {
  const PlannedObject& object = *objects_[index];
  ObjectContact& contact = contacts_[index];
  states_[index].held_at = scp;
  contact.in_contact = true;
  contact.force.setZero();
  contact.stored_energy = 0.0;
  const double whole = (scp - device).norm();
  double& hidden = states_[index].hidden;
  hidden = std::min(hidden, whole);
  contact.depth = whole - hidden;
  const Vector3d end = hidden > 0 ? scp + contact.depth / whole * (device - scp) : device;
  states_[index].effects.for_each_spring([&](const auto& effect) {
    contact.force += object.orientation * effect.spring_force(scp, end);
    contact.stored_energy += effect.stored_energy(scp, end);
  });
}

// What effects see of a mesh.
void ContactSolver::stroke(std::uint32_t index, EffectContact& seen,
                           ContactedObject& contacted) noexcept {
  const PlannedObject& object = *objects_[index];
  MeshStroke& stroke = states_[index].stroke;
  stroke.follow(contacted.place, object.place_of(last_device_),
                object.orientation.transpose() * seen.normal, contacted.triangle, contacted.began);
  contacted.place = stroke.place();
  seen.normal = object.orientation * stroke.normal();
}

// Of what is at this point of a body.
const ContactSolver::MovingObject* ContactSolver::moving_as(std::uint32_t index) const noexcept {
  return moving_of_[index] != kNobody ? &moving_[moving_of_[index]] : nullptr;
}

Vector3d ContactSolver::velocity_of(std::uint32_t index, const Vector3d& point) const noexcept {
  const MovingObject* moving = moving_as(index);
  return moving != nullptr ? moving->motion.velocity_at(point) : Vector3d::Zero();
}

// Exact for springs that are held before and after. A surface that comes into touch stores no more
// than what is there then, and gives nothing when it is left.
double ContactSolver::carried_work() const noexcept {
  double sum = 0.0;
  for (const std::uint32_t body : placed_) {
    const MovingObject& moving = moving_[body];
    if (!moving.now.carried) continue;
    const ObjectContact& contact = contacts_[moving.object];
    const bool was = !moving.pushed.isZero(0.0);
    if (!was && !contact.in_contact) continue;
    const Vector3d way = contact.scp - moving.before.position -
                         moving.before.orientation * (moving.motion.orientation.conjugate() *
                                                      (contact.scp - moving.motion.position));
    const double work = 0.5 * (moving.pushed + contact.force).dot(way);
    if (was && contact.in_contact) {
      sum += work;
    } else {
      sum += std::min(work, contact.in_contact ? contact.stored_energy : 0.0);
    }
  }
  return sum;
}

double ContactSolver::ahead_of(std::uint32_t index) const noexcept {
  const MovingObject* moving = moving_as(index);
  return moving != nullptr ? 0.5 * moving->motion.step : 0.0;
}

std::optional<NearBody> ContactSolver::near_body(std::size_t& next, const Vector3d& velocity,
                                                 double time) const noexcept {
  while (next < placed_.size()) {
    const MovingObject& moving = moving_[placed_[next++]];
    if (contacts_[moving.object].in_contact) continue;
    const PlannedObject& object = moving.now;
    const Vector3d at = object.to_object(last_device_);
    const double speed = (velocity - moving.motion.velocity).norm() +
                         moving.motion.turn_rate.norm() * (last_device_ - object.position).norm();
    const double reach = speed * time + radius_;
    if (distance_below(object.shape, at) > reach) continue;
    const std::optional<Vector3d> nearest = nearest_inside(object.shape, at);
    if (!nearest) continue;
    const double distance = (at - *nearest).norm();
    if (!(distance > radius_) || distance > reach) continue;
    return NearBody{moving.object, object.to_scene(*nearest),
                    object.orientation * ((at - *nearest) / distance), distance - radius_};
  }
  return std::nullopt;
}

Vector3d ContactSolver::effect_force(const Vector3d& velocity, double dt, double gain) noexcept {
  Vector3d total = Vector3d::Zero();
  for (const std::uint32_t i : near_) {
    const ObjectContact& contact = contacts_[i];
    PlannedEffects& effects = states_[i].effects;
    EffectContact seen{last_device_,  contact.scp, contact.normal,    velocity, contact.force,
                       contact.depth, dt,          contact.in_contact};
    if (objects_[i]->moves()) {
      seen.velocity -= velocity_of(i, contact.scp);
      seen.most_viscosity = objects_[i]->most_viscosity(dt);
    }
    if (!effects.has_declared_forces()) {
      effects.for_each_always([&]<class Effect>(Effect& effect) {
        if constexpr (GivesForce<Effect>) total += effect.force(seen);
      });
      continue;
    }
    ContactedObject object = seen_of(*objects_[i], contact, states_[i].began, gain);
    if (contact.in_contact) seen.object = &object;
    if (contact.in_contact && objects_[i]->is_mesh()) stroke(i, seen, object);
    effects.for_each([&]<class Effect>(Effect& effect) {
      if constexpr (GivesForce<Effect>) total += effect.force(seen);
    });
  }
  return total;
}

ContactResult ContactSolver::sum(const Vector3d& device) noexcept {
  ContactResult result;
  result.scp = device;
  result.objects = contacts_;
  touched_.clear();
  double deepest = -1.0;
  for (const std::uint32_t i : near_) {
    ObjectContact& contact = contacts_[i];
    contact.started_inside = states_[i].started_inside;
    result.started_inside |= contact.started_inside;
    if (!contact.in_contact) continue;
    touched_.push_back(i);
    result.in_contact = true;
    result.force += contact.force;
    result.stored_energy += contact.stored_energy;
    if (contact.depth <= deepest) continue;
    deepest = contact.depth;
    result.deepest = i;
    result.scp = contact.scp;
    result.normal = contact.normal;
  }
  result.touched = touched_;
  return result;
}

ContactResult ContactSolver::nothing() const noexcept {
  ContactResult result;
  result.scp = last_device_;
  return result;
}

std::uint64_t ContactSolver::friction_calls() const noexcept {
  std::uint64_t calls = 0;
  for (const FrictionCone* cone : cones_) {
    if (cone != nullptr) calls += cone->calls();
  }
  return calls;
}

}  // namespace reckon::haptics
