// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/pressed_bodies.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace reckon::haptics {

using Eigen::Vector3d;

namespace {

constexpr double kSoon = 3.0;  // periods, in which what comes nearer may be met

}  // namespace

template <int axes>
PressedBodiesOf<axes>::PressedBodiesOf(std::shared_ptr<BodyWorld> world, std::size_t probes,
                                       double patch)
    : world_(std::move(world)), patch_(patch) {
  if (!world_) return;
  hand_ = world_->add_hand();
  pushes_.reserve(probes * world_->states().size());
}

template <int axes>
void PressedBodiesOf<axes>::settle(std::chrono::nanoseconds now, bool frozen,
                                   EnergyLedger& ledger) noexcept {
  if (!world_) return;
  world_->advance_to(now, frozen);
  for (const Push& push : pushes_) {
    const double work = world_->work(push.number);
    ledger.book(-work);
    work_ += work;
  }
  pushes_.clear();
}

template <int axes>
void PressedBodiesOf<axes>::place(StaticContactOf<axes>& contacts) const noexcept {
  if (!world_) return;
  const std::span<const BodyState> states = world_->states();
  for (std::uint32_t i = 0; i < states.size(); ++i) contacts.place(i, states[i]);
}

template <int axes>
void PressedBodiesOf<axes>::foresee(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts,
                                    double period) noexcept {
  if (!world_) return;
  for (std::size_t probe = 0; probe < tool.size(); ++probe) {
    const WallContact& walls = contacts.walls(probe);
    const Vector3d velocity = tool.velocity(probe);
    for (const std::uint32_t index : walls.result().touched) {
      const ObjectContact& contact = walls.result().objects[index];
      BodySpring spring;
      spring.point = contact.scp;
      spring.force = -walls.gain() * contact.force;
      spring.normal = contact.normal;
      spring.velocity = velocity;
      press(walls, probe, index, spring);
    }
    std::size_t next = 0;
    while (const auto near = walls.near_body(next, velocity, kSoon * period)) {
      BodySpring spring;
      spring.point = near->point;
      spring.normal = near->normal;
      spring.gap = near->gap;
      spring.velocity = velocity;
      press(walls, probe, near->index, spring);
    }
  }
  world_->foresee(hand_, period);
  std::array<Vector3d, kMostProbes> change;
  change.fill(Vector3d::Zero());
  for (const Push& push : pushes_) change[push.probe] -= world_->change(push.number);
  for (std::size_t probe = 0; probe < tool.size(); ++probe) contacts.foresee(probe, change[probe]);
}

template <int axes>
void PressedBodiesOf<axes>::press(const WallContact& walls, std::size_t probe, std::uint32_t object,
                                  BodySpring spring) noexcept {
  const std::span<const BodyState> states = world_->states();
  const auto body = std::ranges::find(states, object, &BodyState::object);
  if (body == states.end() || body->carried) return;
  spring.body = static_cast<std::size_t>(body - states.begin());
  spring.stiffness = walls.stiffness_of(object);
  spring.friction = walls.friction_of(object);
  spring.probe = probe;
  spring.patch = patch_;
  const std::size_t number = world_->press(hand_, spring);
  if (number != BodyWorld::kNoPush) pushes_.push_back({number, probe, object, walls.gain()});
}

template <int axes>
void PressedBodiesOf<axes>::hold(const StaticContactOf<axes>& contacts, double share) noexcept {
  for (const Push& push : pushes_) {
    const WallContact& walls = contacts.walls(push.probe);
    const double kept = push.gain > 0 ? walls.gain() / push.gain : 0.0;
    world_->hold(push.number, share * kept, -share * walls.effects_of(push.object));
  }
}

template class PressedBodiesOf<3>;
template class PressedBodiesOf<6>;

}  // namespace reckon::haptics
