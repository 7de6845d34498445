// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/hand_pushes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kLongestSubstep = 5e-4;  // [s], of a prediction
constexpr double kRight = 0.15;           // greatest dt sqrt(K / m)
constexpr double kLeverage = 0.4;         // least effective mass of a rotating body, over its mass

}  // namespace

HandPushes::HandPushes(BodySolver& solver) : solver_(solver) {
  for (std::vector<BodyPush>* pushes : {&pushes_, &last_, &kept_})
    pushes->reserve(BodyWorld::kMostPushes);
  works_.reserve(BodyWorld::kMostPushes);
  forces_.reserve(2 * BodyWorld::kMostPushes);
}

bool HandPushes::has_any_of(std::size_t hand) const noexcept {
  return std::ranges::any_of(pushes_, [hand](const BodyPush& push) { return push.hand() == hand; });
}

BodySet HandPushes::present() const noexcept {
  BodySet out = pushed();
  for (const BodyPush& push : last_)
    if (is_due(push)) out |= BodySet{1} << solver_.slots().slot_of(push.body());
  return out;
}

std::size_t HandPushes::add(const BodyPush& push) noexcept {
  BodyPush& added = pushes_.emplace_back(push);
  for (const BodyPush& before : last_) added.take_twist(before);
  return pushes_.size() - 1;
}

void HandPushes::end(std::size_t body) noexcept {
  for (BodyPush& push : pushes_)
    if (push.body() == body) push = BodyPush(body, push.place(), Vector3d::Zero());
}

void HandPushes::end_period() noexcept {
  for (BodyPush& push : pushes_) push.renew();
  std::swap(pushes_, last_);
  pushes_.clear();
}

void HandPushes::clear() noexcept {
  begin_works();
  last_.clear();
  pushes_.clear();
}

// A hand that has not stepped yet in this period keeps its push of the last one.
bool HandPushes::is_due(const BodyPush& push) const noexcept {
  return push.stiffness() > 0 && (stepped_ >> push.hand() % 64 & 1) == 0;
}

std::size_t HandPushes::steps_for(double period) const noexcept {
  std::array<double, BodySlots::kMost> stiffness{};
  for (const BodyPush& push : pushes_)
    stiffness[solver_.slots().slot_of(push.body())] += push.stiffness();
  for (const BodyPush& push : last_)
    if (is_due(push)) stiffness[solver_.slots().slot_of(push.body())] += push.stiffness();
  double most = 0.0;
  for (std::size_t i = 0; i < solver_.size(); ++i)
    if (!solver_.is_carried(i)) most = std::max(most, stiffness[i] / (kLeverage * solver_.mass(i)));
  const double wanted = std::ceil(period * std::sqrt(most) / kRight);
  return static_cast<std::size_t>(std::clamp(std::max(wanted, std::ceil(period / kLongestSubstep)),
                                             2.0, double{kMostSubsteps}));
}

void HandPushes::foresee_step(std::size_t hand, double time, double dt) noexcept {
  forces_.clear();
  for (BodyPush& push : pushes_)
    add_force(push, push.hand() == hand ? push.next() : push.mean(time, time + dt), 1.0);
  for (BodyPush& push : last_)
    if (is_due(push)) add_force(push, push.next(), 1.0);
  solver_.step(dt, forces_);
  for (BodyPush& push : pushes_)
    if (push.hand() == hand) follow(push, dt);
  for (BodyPush& push : last_)
    if (is_due(push)) follow(push, dt);
}

void HandPushes::add_force(BodyPush& push, const Vector3d& force, double share) noexcept {
  const std::size_t slot = solver_.slots().slot_of(push.body());
  const Vector3d torque =
      push.torque(solver_.motion(slot).turn_rate, solver_.least_inertia(slot), share);
  forces_.push_back({slot, push.place(), force, torque});
}

void HandPushes::follow(BodyPush& push, double dt) noexcept {
  const std::size_t slot = solver_.slots().slot_of(push.body());
  const ObjectMotion at = solver_.motion(slot);
  push.follow(solver_.velocity(slot, push.place()), at.turn_rate, at.orientation, dt);
}

void HandPushes::move(BodySet some, double from, double to, double steps) noexcept {
  const auto acts = [&](const BodyPush& push) {
    return (some >> solver_.slots().slot_of(push.body()) & 1) != 0;
  };
  const double length = (to - from) / steps;
  solver_.only(some);
  for (double i = 0; i < steps; ++i) {
    const double time = from + i * length, next = time + length;
    forces_.clear();
    for (BodyPush& push : pushes_)
      if (acts(push)) add_force(push, push.mean(time, next), push.share());
    solver_.step(length, forces_);
    solver_.note_contacts();
    std::size_t force = 0;
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
      if (!acts(pushes_[k])) continue;
      works_[k] += forces_[force++].work;
      follow(pushes_[k], length);
    }
  }
  solver_.only(BodySolver::all());
}

bool HandPushes::foresee(std::size_t hand, double period, const Prediction& of) noexcept {
  for (BodyPush& push : pushes_)
    if (push.hand() == hand) push.begin(period, of.steps);
  solver_.only(of.bodies);
  solver_.keep();
  solver_.allow({.has_impacts = of.has_impacts});
  const double dt = period / static_cast<double>(of.steps), before = solver_.work();
  bool is_done = true;
  for (std::size_t i = 0; i < of.steps && is_done; ++i) {
    foresee_step(hand, dt * static_cast<double>(i), dt);
    is_done = solver_.work() - before <= of.most;
  }
  solver_.restore();
  solver_.only(BodySolver::all());
  for (BodyPush& push : pushes_)
    if (push.hand() == hand) push.rewind();
  for (BodyPush& push : last_) push.rewind();
  return is_done;
}

}  // namespace reckon::haptics
