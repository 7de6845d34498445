// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/pressed_bodies.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <ranges>
#include <span>
#include <utility>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/servo/body_springs.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {

using Eigen::Vector3d;

namespace {

// An upper bound of the length, at most 1.8 times as long, without a square root.
double most_length(const Vector3d& v) noexcept { return v.cwiseAbs().sum(); }

}  // namespace

template <int axes>
PressedBodiesOf<axes>::PressedBodiesOf(std::shared_ptr<BodyWorld> world, const EffectPlan& plan,
                                       const ServoConfig& config, std::size_t probes,
                                       double stiffness_cap)
    : world_(std::move(world)),
      radius_(config.contact_radius),
      patch_(config.patch_radius),
      pad_(std::max(config.patch_radius, config.probe_radius)),
      buttons_(config.grab_buttons) {
  if (!world_) return;
  hand_ = world_->add_hand();
  pushes_.reserve(std::min(probes * (world_->states().size() + 1), BodyWorld::kMostPushes));
  gifts_.reserve(pushes_.capacity());
  body_of_.assign(plan.objects().size(), kNoBody);
  const double period = pdu::to_seconds(config.period);
  for (const BodyState& body : world_->states()) {
    const PlannedObject& object = plan.objects()[body.object];
    const auto held = [&](const GrabSpring& spring) {
      return object.is_body() ? held_by(spring, object.matter.mass, period, stiffness_cap)
                              : GrabSpring{};
    };
    body_of_[body.object] = static_cast<std::uint32_t>(holds_.size());
    holds_.push_back({held(config.grab), held(object.grab)});
  }
}

template <int axes>
double PressedBodiesOf<axes>::grab_stiffness() const noexcept {
  double least = 0.0;
  for (const Hold& hold : holds_) {
    const double one = hold.by_button.stiffness;
    if (one > 0 && (least == 0.0 || one < least)) least = one;
  }
  return least;
}

template <int axes>
void PressedBodiesOf<axes>::settle(std::chrono::nanoseconds now, bool frozen,
                                   EnergyLedger& ledger) noexcept {
  if (!world_) return;
  world_->advance_to(now, frozen);
  gifts_.clear();
  for (const Push& push : pushes_) {
    const double work = world_->work(push.number);
    ledger.book(-work);
    work_ += work;
    if (work > 0) gifts_.push_back({body_of_[push.object], work});
  }
  pushes_.clear();
}

// A body gets the work of its full spring, but the hand feels more than the rest if the port could
// not pay for a reduction. The body then returns energy.
template <int axes>
void PressedBodiesOf<axes>::repay(EnergyLedger& ledger) noexcept {
  for (const Gift& gift : gifts_) {
    const double back = world_->take_back(gift.body, std::min(gift.energy, ledger.debt()));
    ledger.book(back);
    work_ -= back;
  }
  gifts_.clear();
}

template <int axes>
HandReach PressedBodiesOf<axes>::reach_of(const ToolOf<axes>& tool,
                                          const StaticContactOf<axes>& contacts) const noexcept {
  HandReach reach{tool.place(), 0.0, 0.0};
  for (std::size_t probe = 0; probe < tool.size(); ++probe) {
    const Vector3d at = tool.place(probe);
    const ContactResult& walls = contacts.walls(probe).result();
    const double depth = walls.in_contact ? most_length(walls.scp - at) : 0.0;
    const double away = probe > 0 ? (at - reach.middle).norm() : 0.0;
    reach.radius = std::max(reach.radius, away + depth + radius_);
    reach.speed = std::max(reach.speed, most_length(tool.velocity(probe)));
  }
  return reach;
}

template <int axes>
void PressedBodiesOf<axes>::place(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts,
                                  double period, EnergyLedger& ledger) noexcept {
  if (!world_) return;
  placed_ = 0;
  const auto put = [&](std::size_t body) {
    ++placed_;
    if (world_->states()[body].copied) pay_for_draw(contacts, body, ledger);
    const auto number = static_cast<std::uint32_t>(body);
    contacts.set_carried(number, world_->states()[body].carried);
    contacts.place(number, world_->states()[body], world_->state_before(body));
  };
  reach_ = reach_of(tool, contacts);
  const std::span<const std::uint32_t> near = world_->near(hand_, reach_, period);
  for (const std::uint32_t body : near) put(body);
  for (std::size_t probe = 0; probe < tool.size(); ++probe) {
    // A body that was put elsewhere may be far from the hand that touched it.
    for (const std::uint32_t object : contacts.walls(probe).result().touched) {
      const std::uint32_t body = body_of_[object];
      if (body != kNoBody && std::ranges::find(near, body) == near.end()) put(body);
    }
    const Grab& grab = contacts.grab(probe);
    const auto is_held = [&](std::size_t before) {
      return contacts.grab(before).holds() && contacts.grab(before).body() == grab.body();
    };
    if (!grab.holds() || std::ranges::find(near, grab.body()) != near.end()) continue;
    const auto earlier = std::views::iota(std::size_t{0}, probe);
    if (std::ranges::none_of(earlier, is_held)) put(grab.body());
  }
}

template <int axes>
void PressedBodiesOf<axes>::pay_for_draw(const StaticContactOf<axes>& contacts, std::size_t body,
                                         EnergyLedger& ledger) noexcept {
  const BodyState& state = world_->states()[body];
  const auto pay = [&](const Vector3d& point, const Vector3d& force) {
    const Vector3d way = state.drawn + state.drawn_turn.cross(point - state.position);
    // Gives now what no pending force needs, and owes the rest.
    const double wanted = force.dot(way) - owed_;
    const double paid = world_->take_from_guest(std::max(wanted, -ledger.greatest_gift()));
    owed_ = wanted < 0 ? paid - wanted : 0.0;
    ledger.book(paid);
    work_ -= paid;
  };
  for (std::size_t probe = 0; probe < contacts.probes(); ++probe) {
    const Grab& grab = contacts.grab(probe);
    if (grab.holds() && grab.body() == body) pay(grab.point(), grab.spring_force());
    const WallContact& walls = contacts.walls(probe);
    if (walls.result().objects.empty()) continue;
    const ObjectContact& contact = walls.result().objects[state.object];
    if (contact.in_contact && !jumps(state, world_->state_before(body)))
      pay(contact.scp, walls.gain() * contact.force);
  }
}

template <int axes>
void PressedBodiesOf<axes>::place_all(StaticContactOf<axes>& contacts) const noexcept {
  if (!world_) return;
  const std::span<const BodyState> states = world_->states();
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    contacts.set_carried(i, states[i].carried);
    contacts.place(i, states[i], states[i]);
  }
}

template <int axes>
void PressedBodiesOf<axes>::grab(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts,
                                 std::uint32_t pressed, EnergyLedger& ledger) noexcept {
  if (!world_ || placed_ == 0) return;
  const bool is_pressed = (pressed & buttons_) != 0;
  for (std::size_t probe = 0; probe < tool.size(); ++probe) {
    Grab& grab = contacts.grab(probe);
    const bool is_gone = grab.holds() && world_->states()[grab.body()].carried;
    if (is_gone || grab.tears() || (grab.holds() && by_[probe] && !is_pressed))
      grab.release(ledger);
    if (!grab.holds()) take(tool, contacts, probe, is_pressed);
  }
}

// Grabs the body with the greatest contact force.
template <int axes>
void PressedBodiesOf<axes>::take(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts,
                                 std::size_t probe, bool pressed) noexcept {
  const ContactResult& touched = contacts.walls(probe).result();
  const std::span<const BodyState> states = world_->states();
  double most = 0.0;
  for (const std::uint32_t object : touched.touched) {
    const std::uint32_t i = body_of_[object];
    if (i == kNoBody || states[i].carried) continue;
    const double force = touched.objects[object].force.norm();
    const Hold& hold = holds_[i];
    const bool by_button = pressed && hold.by_button.stiffness > 0;
    const GrabSpring& spring = by_button ? hold.by_button : hold.by_touch;
    if (!(force > most) || !(spring.stiffness > 0)) continue;
    most = force;
    by_[probe] = by_button;
    contacts.grab(probe).take(i, spring, tool.place(probe), states[i]);
  }
}

template <int axes>
void PressedBodiesOf<axes>::foresee(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts,
                                    double period) noexcept {
  if (!world_) return;
  for (std::size_t probe = 0; placed_ > 0 && probe < tool.size(); ++probe) {
    const WallContact& walls = contacts.walls(probe);
    const Vector3d velocity = tool.velocity(probe);
    visit_body_springs(
        walls, [this](std::uint32_t index) { return body_of_[index] != kNoBody; }, velocity,
        kSpringsAhead * period,
        [&](std::uint32_t index, const BodySpring& spring) { press(probe, index, spring); });
    const Grab& grab = contacts.grab(probe);
    if (grab.holds()) press_held(grab, probe, velocity);
  }
  world_->foresee(hand_, period);
  if (!std::exchange(foresaw_, !pushes_.empty()) && !foresaw_) return;
  std::array<Vector3d, kMostProbes> of_walls, of_grab;
  of_walls.fill(Vector3d::Zero());
  of_grab.fill(Vector3d::Zero());
  for (const Push& push : pushes_)
    (push.grips ? of_grab : of_walls)[push.probe] -= world_->change(push.number);
  for (std::size_t probe = 0; probe < tool.size(); ++probe) {
    contacts.foresee(probe, of_walls[probe]);
    contacts.grab(probe).foresee(of_grab[probe]);
  }
}

template <int axes>
void PressedBodiesOf<axes>::press_held(const Grab& grab, std::size_t probe,
                                       const Vector3d& velocity) noexcept {
  world_->touch(static_cast<std::uint32_t>(grab.body()));
  BodySpring spring = spring_of(grab, velocity, pad_);
  spring.probe = probe;
  const std::size_t number = world_->press(hand_, spring);
  if (number != BodyWorld::kNoPush)
    pushes_.push_back({number, probe, world_->states()[spring.body].object, true});
}

template <int axes>
void PressedBodiesOf<axes>::press(std::size_t probe, std::uint32_t object,
                                  BodySpring spring) noexcept {
  const std::uint32_t body = body_of_[object];
  if (!(spring.gap > 0)) world_->touch(body);
  if (world_->states()[body].carried) return;
  spring.body = body;
  spring.probe = probe;
  spring.patch = patch_;
  const std::size_t number = world_->press(hand_, spring);
  if (number != BodyWorld::kNoPush) pushes_.push_back({number, probe, object, false});
}

template <int axes>
bool PressedBodiesOf<axes>::touches_copy(const StaticContactOf<axes>& contacts) const noexcept {
  for (std::size_t probe = 0; world_ && probe < contacts.probes(); ++probe) {
    for (const std::uint32_t index : contacts.walls(probe).result().touched)
      if (body_of_[index] != kNoBody && world_->states()[body_of_[index]].copied) return true;
  }
  return false;
}

template <int axes>
void PressedBodiesOf<axes>::hold(const StaticContactOf<axes>& contacts, double springs,
                                 double effects) noexcept {
  for (const Push& push : pushes_) {
    Vector3d rest = Vector3d::Zero();
    if (!push.grips) rest = -effects * contacts.walls(push.probe).effects_of(push.object);
    world_->hold(push.number, springs, rest);
  }
  if (world_) world_->written(hand_, reach_);
}

template class PressedBodiesOf<3>;
template class PressedBodiesOf<6>;

}  // namespace reckon::haptics
