// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_push.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {

using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double kLossy = 0.25;  // share of a period, see mean()
// Rotational stiffness of a patch, over the inertia [1/s^2]: the stiffest for steps of half a
// period at 1 kHz.
constexpr double kTwist = 0.0225 / (0.5e-3 * 0.5e-3);
constexpr double kFastestRest =
    400.0;  // [1/s], greatest rate at which a grip damps the rotation of a body

}  // namespace

BodyPush::BodyPush(std::size_t hand, const BodySpring& spring, const Vector3d& at,
                   const Quaterniond& turned) noexcept
    : hand_(hand),
      body_(spring.body),
      place_(turned.conjugate() * (spring.point - at)),
      velocity_(spring.velocity),
      probe_(spring.probe),
      patch_(spring.patch),
      grips_(spring.grips),
      viscosity_(spring.viscosity),
      turning_(spring.turning),
      dragged_(spring.drag),
      drag_(spring.drag),
      stiffness_(spring.stiffness),
      friction_(spring.friction),
      first_(spring.force),
      late_(spring.force) {
  if (grips_) {
    begun_ = tension_ = {0.0, spring.force, spring.normal, 0.0, true};
    return;
  }
  // A smooth surface pushes along its present force, at an edge too.
  const double size = spring.force.norm();
  const bool is_rough = spring.friction > 0 && spring.force.dot(spring.normal) < 0;
  const Vector3d normal = is_rough || !(size > 0) ? spring.normal : Vector3d(-spring.force / size);
  normal_ = turned.conjugate() * normal;
  const double across = -spring.force.dot(normal);
  begun_ = {across - spring.stiffness * spring.gap, spring.force + across * normal, normal};
  tension_ = begun_;
  if (is_rough) friction_ = std::max(friction_, begun_.along.norm() / across);
}

BodyPush::BodyPush(std::size_t body, const Vector3d& place, const Vector3d& force) noexcept
    : body_(body), place_(place), first_(force), late_(force) {
  hold(1.0, Vector3d::Zero());
}

void BodyPush::begin(double period, std::size_t steps) noexcept {
  steps_ = std::clamp<std::size_t>(steps, 1, kMostSubsteps);
  step_ = period / static_cast<double>(steps_);
  noted_ = 0;
}

void BodyPush::rewind() noexcept {
  tension_ = begun_;
  drag_ = dragged_;
}

void BodyPush::renew() noexcept {
  begun_ = tension_;
  dragged_ = drag_;
}

Vector3d BodyPush::next() noexcept {
  const Vector3d force = tension_.force() + drag_;
  if (noted_ < steps_) forces_[noted_++] = force;
  return force;
}

void BodyPush::take_twist(const BodyPush& before) noexcept {
  const bool is_same = !grips_ && !before.grips_ && before.hand_ == hand_ &&
                       before.body_ == body_ && before.probe_ == probe_ && patch_ > 0;
  if (is_same && before.tension_.across > 0) begun_.twist = tension_.twist = before.tension_.twist;
}

Vector3d BodyPush::torque(const Vector3d& turn_rate, double inertia, double share) noexcept {
  if (grips_) return -share * std::min(turning_, kFastestRest * inertia) * turn_rate;
  if (!(patch_ > 0) || !(stiffness_ > 0) || !(tension_.across > 0)) return Vector3d::Zero();
  const double rate = turn_rate.dot(tension_.normal);
  const double stiffness = kTwist * inertia;
  const double most = 2.0 / 3.0 * share * friction_ * patch_ * tension_.across;
  const double wanted = -stiffness * tension_.twist - 1.4 * std::sqrt(kTwist) * inertia * rate;
  const double held = std::clamp(wanted, -most, most);
  // Slip reduces the twist to the friction limit.
  if (held != wanted)
    tension_.twist = std::clamp(tension_.twist, -most / stiffness, most / stiffness);
  return held * tension_.normal;
}

void BodyPush::follow(const Vector3d& velocity, const Vector3d& turn_rate,
                      const Quaterniond& turned, double dt) noexcept {
  if (!(stiffness_ > 0)) return;
  const Vector3d normal = turned * normal_;
  const Vector3d rate = stiffness_ * (velocity_ - velocity);
  tension_ = after(dt * rate, normal);
  drag_ = viscosity_ * (velocity_ - velocity);
  tension_.twist += dt * turn_rate.dot(normal);
  if (!(tension_.across > 0)) tension_.twist = 0.0;
  late_ = after(kLossy * static_cast<double>(steps_) * step_ * rate, normal).force();
}

// Tension beyond the friction limit slides away.
BodyPush::Tension BodyPush::after(const Vector3d& change, const Vector3d& normal) const noexcept {
  if (grips_) return {0.0, tension_.along + change, normal, 0.0, true};
  const double away = change.dot(normal);
  Tension out{tension_.across - away, tension_.along + change - away * normal, normal,
              tension_.twist};
  const double size = out.along.norm(), most = friction_ * std::max(0.0, out.across);
  if (size > most) out.along *= most / size;
  return out;
}

// Only a grip can pull.
Vector3d BodyPush::Tension::force() const noexcept {
  if (grips) return along;
  if (!(across > 0)) return Vector3d::Zero();
  return along - across * normal;
}

Vector3d BodyPush::change() const noexcept {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < noted_; ++i) sum += forces_[i] - first_;
  return noted_ > 0 ? Vector3d(sum / static_cast<double>(noted_)) : sum;
}

void BodyPush::hold(double share, const Vector3d& rest) noexcept {
  share_ = share;
  rest_ = rest;
}

Vector3d BodyPush::mean(double from, double to) const noexcept {
  Vector3d sum = Vector3d::Zero();
  double rest = to - from;
  for (std::size_t i = 0; i < noted_; ++i) {
    const double begin = static_cast<double>(i) * step_;
    const double part = std::min(begin + step_, to) - std::max(begin, from);
    if (!(part > 0)) continue;
    sum += part * held(forces_[i]);
    rest -= part;
  }
  return (sum + std::max(0.0, rest) * held(late_)) / (to - from);
}

BodySet slots_of(std::span<const BodyPush> pushes, const BodySlots& slots) noexcept {
  BodySet out = 0;
  for (const BodyPush& push : pushes) out |= BodySet{1} << slots.slot_of(push.body());
  return out;
}

std::size_t most_steps(std::span<const BodyPush> pushes) noexcept {
  std::size_t steps = 1;
  for (const BodyPush& push : pushes) steps = std::max(steps, push.steps());
  return steps;
}

}  // namespace reckon::haptics
