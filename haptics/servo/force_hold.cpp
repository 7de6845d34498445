// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits the force that a servo's step writes: by energy, rate and the device's limit.
#include <algorithm>

#include "reckon/haptics/passivity/rate_limit.hpp"
#include "reckon/haptics/servo/servo_step.hpp"

namespace reckon::haptics {
namespace {

constexpr double kToSpare = 1.05;   // margin over the energy that the whole force needs
constexpr double kShakeRate = 0.5;  // of the fastest growth of the force, for oscillations

template <class Force>
Force stepped_to(const Force& from, const Force& to, double most) {
  const Force way = to - from;
  const double length = way.norm();
  return length > most ? Force(from + most / length * way) : to;
}

}  // namespace

// A contact whose force is cut to zero releases, and fades in again from there.
template <int axes>
void ServoStepOf<axes>::reduce(double scale) noexcept {
  static_.attenuate(scale, port_);
  if (scale > 0.0) return;
  static_.drop();
  for (RemoteContact* remote : hands_.all()) remote->drop();
}

// A cut lowers the gain of the walls, which at once begins to rise again. Their full force is
// therefore greater than the force of this step.
template <int axes>
void ServoStepOf<axes>::note_limit(const Force& force, double scale) noexcept {
  limit_share_ = 1.0;
  if (!(scale > 0.0) || scale >= 1.0 || safety_.ramps()) return;
  const Force asked = force + static_.held_back(tool_);
  limit_share_ = std::min(1.0, scale * force.norm() / asked.norm());
  tally_.limit.note(limit_share_, newtons(asked), step_.dt);
}

template <int axes>
typename ServoStepOf<axes>::Force ServoStepOf<axes>::hold(Load& load) noexcept {
  const bool shakes = port_.shakes() || !load.shake.isZero(0.0);
  const Force wish = load.shake;
  if (shakes)
    load.shake = stepped_to<Force>(port_.shaking(), wish, kShakeRate * port_rate_ * elapsed_);
  held_ = port_.hold(load, period_);
  if (held_.walls < 1.0) {
    static_.attenuate(held_.walls, port_);
    load.walls *= held_.walls;
    load.walls_slope *= held_.walls;
    load.walls_stored *= held_.walls;
  }
  tally_.held_back.note_force(held_.springs, tool_.force(load.springs), step_.dt);
  tally_.effects.note_force(held_.extra, tool_.force(load.extra), step_.dt);
  static_.shown(held_.extra);
  if (shakes) shake(load, wish);
  const Force force = keep_rate(load, held_.force);
  const double whole = held_.force.norm();
  const double reached = whole > 0 ? std::min(1.0, (force - port_.shaking()).norm() / whole) : 1.0;
  const double share = springs_.crowd_share() * held_.springs * reached;
  for (RemoteContact* remote : hands_.all()) {
    remote->shown(springs_.guests().share_of(*remote) * share, port_.free());
  }
  tally_.rate.note(reached, newtons(held_.force), step_.dt);
  if (softening_.share() < 1.0) {
    tally_.softened.note(softening_.share(), newtons(load.springs) / softening_.share(), step_.dt);
  }
  soften(load, held_.springs);
  return force;
}

template <int axes>
void ServoStepOf<axes>::shake(const Load& load, const Force& wish) noexcept {
  const Force& shown = port_.shake(load, period_);
  const double whole = wish.norm();
  const double share = whole > 0 ? std::min(1.0, shown.norm() / whole) : 1.0;
  static_.shook(share);
  tally_.effects.note_force(share, tool_.force(wish), step_.dt);
}

// A crease, an edge or a quick blow turns the force within one sample. The force follows at a
// limited rate, which the port accounts for like any held force. If the energy does not allow that,
// the whole force is reduced. The limit applies to the sum with the oscillations.
template <int axes>
typename ServoStepOf<axes>::Force ServoStepOf<axes>::keep_rate(const Load& load,
                                                               const Force& held) noexcept {
  const Force wanted = held + port_.shaking();
  if (!wanted.allFinite()) return wanted;  // safety handles it
  const double most = port_rate_ * elapsed_;
  const Force near_by = nearest_in_reach(written_, wanted, most);
  if (near_by == wanted || port_.hold_instead(load, near_by - port_.shaking(), period_))
    return near_by;
  const double part = part_in_reach(written_, wanted, most);
  static_.attenuate(part, port_);
  port_.attenuate(part);
  return part * wanted;
}

template <int axes>
void ServoStepOf<axes>::soften(const Load& load, double held) noexcept {
  double whole = 0.0;  // [J]
  if (load.stored > 0) {
    const double pays = port_.spare(load.walls_slope, period_);
    if (pays > 0) whole = load.springs.squaredNorm() / (4 * pays);
  }
  softening_.learn(held, port_.level() > kToSpare * whole, load.stored > 0, step_.dt);
  step_.softening = softening_.share();
}

template AxisForces<3> ServoStepOf<3>::hold(PortLoadOf<3>&) noexcept;
template AxisForces<6> ServoStepOf<6>::hold(PortLoadOf<6>&) noexcept;
template void ServoStepOf<3>::reduce(double) noexcept;
template void ServoStepOf<6>::reduce(double) noexcept;
template void ServoStepOf<3>::note_limit(const AxisForces<3>&, double) noexcept;
template void ServoStepOf<6>::note_limit(const AxisForces<6>&, double) noexcept;

}  // namespace reckon::haptics
