// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_world.hpp"

#include <utility>

#include "reckon/haptics/bodies/body_engine.hpp"

namespace reckon::haptics {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

std::size_t BodyStates::copy_island(std::size_t body,
                                    std::span<std::uint32_t> room) const noexcept {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < bodies.size() && count < room.size(); ++i)
    if (bodies[i].island == bodies[body].island) room[count++] = i;
  return count;
}

BodyWorld::BodyWorld(const EffectPlan& plan, const Vector3d& gravity,
                     std::shared_ptr<ObjectMover> mover, const WorkSpace& work_space)
    : engine_(std::make_unique<BodyEngine>(plan, gravity, std::move(mover), work_space)),
      was_awake_(engine_->states().size(), 0) {
  orders_.reserve(kMostOrders);
  for (const PlannedObject& object : plan.objects()) {
    if (!object.moves()) continue;
    PlannedObject apart = object;
    apart.place(Vector3d::Zero(), Eigen::Matrix3d::Identity());
    boxes_.push_back(apart.bounds);
  }
  // Reserves memory in each slot of the buffers.
  for (TripleBuffer<BodyStates>* to : {&published_, &outgoing_}) {
    for (int i = 0; i < 3; ++i) {
      to->write_slot().bodies.reserve(engine_->states().size());
      to->publish();
      static_cast<void>(to->update());
    }
  }
  publish();
}
BodyWorld::~BodyWorld() = default;

// Publishes the last states here if not all hands have written: forces come before states.
void BodyWorld::advance_to(nanoseconds now, bool frozen) noexcept {
  if (is_due_ && now != engine_->time()) publish();
  if (has_orders() && engine_->is_before(now)) {
    for (const BodyOrder& order : orders_) obey(0, order);
    orders_.clear();
    exchange_.take([this](std::uint64_t serial, const BodyOrder& order) { obey(serial, order); });
  }
  if (!engine_->advance_to(now, frozen)) return;
  is_due_ = true;
  if (!engine_->has_hands()) publish();
  if (guest_ != nullptr) guest_->step(now, frozen);
}

bool BodyWorld::order(const BodyOrder& order) noexcept {
  if (orders_.size() == kMostOrders) return false;
  orders_.push_back(order);
  return true;
}

void BodyWorld::obey(std::uint64_t serial, const BodyOrder& order) noexcept {
  BodyEnd end{serial, order.body, false, engine_->time(), {}};
  end.was_owned = engine_->obey(order, end.state);
  if (!end.was_owned) ++ignored_;
  if (serial == 0) return;
  serial_ = serial;
  if (order.act == BodyAct::disown) exchange_.answer(end);
}

void BodyWorld::publish() noexcept {
  is_due_ = false;
  if (std::exchange(published_version_, engine_->version()) == engine_->version()) return;
  for (TripleBuffer<BodyStates>* to : {&published_, &outgoing_}) {
    bring_up_to_date(to->write_slot());
    to->publish();
  }
  if (trace_ != nullptr) trace_steps();
}

// Bodies without a slot have not moved since they lost it.
void BodyWorld::bring_up_to_date(BodyStates& out) const noexcept {
  const std::span<const BodyState> states = engine_->states();
  const std::uint64_t missed = engine_->woken().left() - out.left;
  const std::span<const std::uint32_t> left = engine_->woken().last_left();
  if (out.bodies.size() != states.size() || missed > left.size()) {
    out.bodies.assign(states.begin(), states.end());
  } else {
    for (const std::uint32_t body : engine_->with_slot()) out.bodies[body] = states[body];
    for (const std::uint32_t body : left.last(static_cast<std::size_t>(missed)))
      out.bodies[body] = states[body];
  }
  out.time = engine_->time();
  out.left = engine_->woken().left();
  out.crowded = engine_->woken().crowded();
  out.serial = serial_;
  out.ignored = ignored_;
}

void BodyWorld::trace_steps() noexcept {
  for (const std::uint32_t body : engine_->with_slot()) {
    const BodyState& state = engine_->states()[body];
    const bool was_awake = std::exchange(was_awake_[body], state.awake ? 1 : 0) != 0;
    if (state.awake || was_awake) static_cast<void>(trace_->push({engine_->time(), state}));
  }
}

std::shared_ptr<BodyWorld> make_bodies(const EffectPlan& plan, const Scene& scene,
                                       std::shared_ptr<ObjectMover> mover) {
  if (!plan.has_moving()) return nullptr;
  return std::make_shared<BodyWorld>(plan, scene.gravity, std::move(mover), scene.work_space);
}

std::size_t BodyWorld::push(std::size_t body, const Vector3d& point,
                            const Vector3d& force) noexcept {
  return engine_->push(body, point, force);
}
bool BodyWorld::is_any_moving() const noexcept { return engine_->is_any_moving(); }
bool BodyWorld::is_mixed() const noexcept { return engine_->is_mixed(); }
void BodyWorld::keep_carried(std::size_t body) noexcept { engine_->keep_carried(body); }

bool BodyWorld::can_own(std::size_t body) const noexcept { return engine_->can_own(body); }
void BodyWorld::touch(std::uint32_t body) noexcept { engine_->touch(body); }
std::size_t BodyWorld::add_hand() { return engine_->add_hand(); }
std::size_t BodyWorld::add_guest(BodyGuest& guest) {
  guest_ = &guest;
  return engine_->add_guest();
}
std::span<const std::uint32_t> BodyWorld::near(std::size_t hand, const HandReach& reach,
                                               double period) noexcept {
  return engine_->near(hand, reach, period);
}
const ObjectMotion& BodyWorld::state_before(std::size_t body) const noexcept {
  return engine_->state_before(body);
}
std::size_t BodyWorld::press(std::size_t hand, const BodySpring& spring) noexcept {
  return engine_->press(hand, spring);
}
void BodyWorld::written(std::size_t hand, const HandReach& reach) noexcept {
  if (!engine_->written(hand, reach)) return;
  if (is_due_) publish();
  if (engine_->has_devices()) engine_->go_ahead();
}
void BodyWorld::foresee(std::size_t hand, double period) noexcept {
  engine_->foresee(hand, period);
}
Vector3d BodyWorld::change(std::size_t push) const noexcept { return engine_->change(push); }
void BodyWorld::hold(std::size_t push, double share, const Vector3d& rest) noexcept {
  engine_->hold(push, share, rest);
}
double BodyWorld::work(std::size_t push) const noexcept { return engine_->work(push); }
double BodyWorld::take_back(std::size_t body, double energy) noexcept {
  return engine_->take_back(body, energy);
}
std::span<const BodyState> BodyWorld::states() const noexcept { return engine_->states(); }
double BodyWorld::work() const noexcept { return engine_->solver().work(); }
void BodyWorld::set_pace(double pace) noexcept { engine_->set_pace(pace); }
double BodyWorld::pace() const noexcept { return engine_->pace(); }
double BodyWorld::energy() const noexcept { return engine_->solver().energy(); }
double BodyWorld::taken_out() const noexcept { return engine_->solver().taken_out(); }
std::uint64_t BodyWorld::approximated() const noexcept { return engine_->solver().approximated(); }
std::uint64_t BodyWorld::coarse() const noexcept { return engine_->coarse(); }
std::uint64_t BodyWorld::crowded() const noexcept { return engine_->woken().crowded(); }

}  // namespace reckon::haptics
