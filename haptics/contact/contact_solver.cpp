// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/contact_solver.hpp"

#include <algorithm>
#include <numeric>

#include "reckon/haptics/contact/contact_shares.hpp"
#include "reckon/haptics/contact/free_place.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

// Far beyond any scene, but near enough that its square does not overflow.
constexpr double kFarthestProbe = 1e9;
constexpr double kBeyond = 0.01;     // [m]
constexpr double kPassedFor = 0.05;  // [s]

bool usable(const Vector3d& device) {
  return device.allFinite() && device.cwiseAbs().maxCoeff() <= kFarthestProbe;
}

}  // namespace

ContactSolver::ContactSolver(const EffectPlan& plan, double radius, double patch_cap)
    : plan_(plan), moving_(plan), radius_(radius), patch_cap_(patch_cap) {
  const std::size_t count = plan.objects().size();
  contacts_.resize(count);
  near_.reserve(count);
  reached_.reserve(count);
  touched_.reserve(count);
  noted_.resize(count);
  states_.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const PlannedObject& object = plan.objects()[i];
    const MovingObject* moving = moving_.moving_as(i);
    objects_.push_back(moving != nullptr ? &moving->now : &object);
    states_.emplace_back(object.effects, radius);
    any_follows_ |= states_.back().follows;
    cones_.push_back(states_.back().cone());
  }
}

ContactResult ContactSolver::reset(const Vector3d& device) noexcept {
  if (!usable(device)) return nothing();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    contacts_[i] = {};
    states_[i].restart(objects_[i]->effects);
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

// The contact point moves with the body that holds it most. Other bodies push it.
void ContactSolver::carry() noexcept {
  const MovingObject* holder = nullptr;
  for (const std::uint32_t body : moving_.placed()) {
    const MovingObject& moving = moving_[body];
    const ObjectContact& contact = contacts_[moving.object];
    if (!contact.in_contact) continue;
    if (holder == nullptr || contact.depth > contacts_[holder->object].depth) holder = &moving;
  }
  if (holder != nullptr) scp_ = holder->now.to_scene(holder->before_of(scp_));
  for (const std::uint32_t body : moving_.placed()) {
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
  moving_.next_round();
  if (!usable(device)) return nothing();
  if (!started_) return reset(device);
  if (any_follows_) follow_place(dt);
  if (!moving_.placed().empty()) carry();
  find_near(device);
  settle(device);
  lost_ = 0.0;
  if (!moving_.placed().empty()) let_through(device, dt);
  for (const std::uint32_t i : near_) states_[i].started_inside &= contacts_[i].in_contact;
  last_device_ = device;
  return sum(device);
}

// A body has passed the hand when the device has been outside of it, far beyond the stretch of its
// springs, for kPassedFor. The SCP then goes to the device as if the body were not there.
void ContactSolver::let_through(const Vector3d& device, double dt) noexcept {
  for (const std::uint32_t body : moving_.placed()) {
    MovingObject& moving = moving_[body];
    const double most = kBeyond + strongest_ / std::min(stiffness_of(moving.object), patch_cap_);
    const bool is_beyond = contacts_[moving.object].in_contact && (device - scp_).norm() > most &&
                           moving.is_outside(device);
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

// A newly touched object starts at its contact point, without sliding.
void ContactSolver::follow_place(double dt) noexcept {
  for (const std::uint32_t i : touched_) {
    FeltObject& state = states_[i];
    if (!state.follows) continue;
    const double depth = std::max((scp_ - last_device_).dot(contacts_[i].normal), 0.0);
    state.follow(objects_[i]->place_of(scp_), cones_[i]->sliding(), contacts_[i], depth, dt);
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
  for (const std::uint32_t body : moving_.placed()) note(moving_[body].object);
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
  // An object without contact no longer slides, and its depth is no longer hidden.
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
  const std::size_t count = find_holders(walk, reached_.front(), scp_ - device, shares);
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

// A new contact begins with the patch below it. An existing one changes to it gradually.
void ContactSolver::note_touch(std::uint32_t index, std::uint32_t triangle) noexcept {
  const PlannedObject& object = *objects_[index];
  FeltObject& state = states_[index];
  state.touch(step_);
  if (object.is_mesh()) contacts_[index].triangle = triangle;
  if (object.patches == nullptr) return;
  contacts_[index].patch = object.patches->of_triangle[triangle];
  if (!state.began) return;
  state.blend.begin(goal_of(index));
  state.adjust(state.blend.now());
}

ContactResult ContactSolver::follow_patches(double dt, double energy) noexcept {
  patch_share_ = 1.0;
  for (const std::uint32_t i : touched_) {
    if (objects_[i]->patches == nullptr) continue;
    PatchBlend& blend = states_[i].blend;
    energy -= blend.follow(goal_of(i), contacts_[i].depth, dt, std::max(0.0, energy));
    patch_share_ = std::min(patch_share_, blend.share());
    states_[i].adjust(blend.now());
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

void ContactSolver::feel(std::uint32_t index, const Vector3d& scp,
                         const Vector3d& device) noexcept {
  states_[index].hold(*objects_[index], scp, device, contacts_[index]);
}

Vector3d ContactSolver::effect_force(const Vector3d& velocity, double dt, double gain) noexcept {
  Vector3d total = Vector3d::Zero();
  for (const std::uint32_t i : near_) {
    const ObjectContact& contact = contacts_[i];
    EffectContact seen{last_device_,  contact.scp, contact.normal,    velocity, contact.force,
                       contact.depth, dt,          contact.in_contact};
    if (objects_[i]->moves()) {
      seen.velocity -= velocity_of(i, contact.scp);
      seen.most_viscosity = objects_[i]->most_viscosity(dt);
    }
    states_[i].add_forces(*objects_[i], contact, seen, gain, total);
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
