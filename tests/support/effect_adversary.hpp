// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand that goes for the energy of effects: half the time it moves as takes most out of the held
// force, samples come late, and the force is cut now and then.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>

#include "reckon/haptics/contact/static_contact.hpp"

namespace reckon::haptics::adversary {

using Eigen::Vector3d;

inline constexpr double kSample = 0.001;
inline constexpr double kDamping = 1.0;  // [N s/m], of the device
inline constexpr int kSteps = 1500;

using Random = std::mt19937;

inline double any(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

/// The device's own books, from the start [J].
struct Books {
  double energy = 0.0, least = 0.0;
  void settle(const Vector3d& force, const Vector3d& dx, double dt) {
    energy += -force.dot(dx) + kDamping * dx.squaredNorm() / dt;
    least = std::min(least, energy);
  }
};

/// The motion of the hand in a sample: that which takes most out of `force`, or any. @param stray
/// [m] of the latter
inline Vector3d motion(Random& random, int step, const Vector3d& force, const Vector3d& device,
                       double dt, double stray) {
  std::normal_distribution<double> normal;
  Vector3d dx = stray * Vector3d(normal(random), normal(random), normal(random));
  if (step % 2 == 0) dx = 0.5 * dt / kDamping * force;
  if (dx.norm() > 0.002) dx *= 0.002 / dx.norm();
  return dx + 0.004 * (Vector3d(0.015, 0.012, 0.012) - device);
}

/// With the gate, or as the effects want it. @return the least of the books, and what late samples
/// account for
struct Least {
  double books, late;
};
[[nodiscard]] inline Least run_gated(const Scene& scene, Random& random, double stray = 2e-4) {
  const EffectPlan plan(scene);
  EnergyPort port(kDamping);
  StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kSample);
  PointTool tool;
  Vector3d device(0.03, 0.02, 0.025), velocity = Vector3d::Zero();
  tool.reset({device});
  contact.reset(tool);
  Books books;
  for (int i = 0; i < kSteps; ++i) {
    PortLoad load;
    tool.set_velocity(velocity);
    contact.load(tool, kSample, load);
    const PortHold held = port.hold(load, kSample);
    if (held.walls < 1.0) contact.attenuate(held.walls, port);
    contact.shown(held.extra);
    Vector3d force = held.force;
    if (i % 97 == 0) {
      contact.attenuate(0.5, port);
      port.attenuate(0.5);
      force *= 0.5;
    }
    const double dt = random() % 20 == 0 ? any(random, 1.0, 4.0) * kSample : kSample;
    const Vector3d dx = motion(random, i, force, device, dt, stray);
    device += dx;
    velocity = dx / dt;
    books.settle(force, dx, dt);
    port.settle(dx, dt);
    tool.move({device});
    contact.settle(tool, dt, port);
    EXPECT_TRUE(force.allFinite()) << i;
  }
  return {books.least, port.late_cost()};
}

/// A hand that puts in next to nothing in a region: it strays by microns about `start` [m, S] and
/// then goes with the force, by the step that takes most out or by any. @return least of the books
/// [J]
[[nodiscard]] inline double stray_and_let_go(const EffectPlan& plan, const Vector3d& start,
                                             Random& random) {
  EnergyPort port(kDamping);
  StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kSample);
  PointTool tool;
  Vector3d device = start, velocity = Vector3d::Zero();
  tool.reset({device});
  contact.reset(tool);
  Books books;
  int stray = 0;
  for (int i = 0; i < 3000; ++i) {
    PortLoad load;
    tool.set_velocity(velocity);
    contact.load(tool, kSample, load);
    const PortHold held = port.hold(load, kSample);
    if (held.walls < 1.0) contact.attenuate(held.walls, port);
    contact.shown(held.extra);
    Vector3d dx =
        Vector3d(any(random, -4e-6, 4e-6), any(random, -4e-6, 4e-6), any(random, -4e-6, 4e-6));
    if (stray-- <= 0) {
      dx = any(random, 0.2, 1.0) * kSample / kDamping * held.force;
      if (stray < -30) {
        stray = static_cast<int>(any(random, 1.0, 60.0));
        dx = 0.2 * (start - device);
      }
    }
    device += dx;
    velocity = dx / kSample;
    books.settle(held.force, dx, kSample);
    port.settle(dx, kSample);
    tool.move({device});
    contact.settle(tool, kSample, port);
  }
  return books.least;
}

/// A hand that puts in next to nothing: it presses by microns from the very surface and lets go by
/// the step that takes most out. @param plan its first object is a box of 40 mm  @return least of
/// the books [J]
[[nodiscard]] inline double press_and_let_go(const EffectPlan& plan, Random& random) {
  const PlannedObject& object = plan.objects()[0];
  EnergyPort port(kDamping);
  StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kSample);
  PointTool tool;
  const Vector3d start = object.to_scene({0.003, 0.001, 0.02 + 1e-6});
  const Vector3d in = object.orientation * Vector3d(0, 0, -1);
  Vector3d device = start, velocity = Vector3d::Zero();
  tool.reset({device});
  contact.reset(tool);
  Books books;
  int press = 0;
  for (int i = 0; i < 3000; ++i) {
    PortLoad load;
    tool.set_velocity(velocity);
    contact.load(tool, kSample, load);
    const PortHold held = port.hold(load, kSample);
    if (held.walls < 1.0) contact.attenuate(held.walls, port);
    contact.shown(held.extra);
    Vector3d dx = any(random, 0.0, 4e-6) * in;
    if (press-- <= 0) {
      dx = 0.5 * kSample / kDamping * held.force;
      if (press < -3) {
        press = static_cast<int>(any(random, 1.0, 60.0));
        dx = 0.2 * (start - device);
      }
    }
    device += dx;
    velocity = dx / kSample;
    books.settle(held.force, dx, kSample);
    port.settle(dx, kSample);
    tool.move({device});
    contact.settle(tool, kSample, port);
  }
  return books.least;
}

/// The greatest fall of what the hand has put in beyond what springs hold [J]: what the effects
/// made. The hand goes for what they add to the surface, where there is any.
[[nodiscard]] inline double made_open(const Scene& scene, Random& random) {
  const EffectPlan plan(scene);
  EnergyPort rich(1e12);  // for which everything is allowed
  StaticContact contact(plan, 1e12);
  PointTool tool;
  Vector3d device(0.03, 0.02, 0.025), velocity = Vector3d::Zero();
  tool.reset({device});
  contact.reset(tool);
  Books books;
  double most = 0.0, made = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    PortLoad load;
    rich.borrow(1.0);
    tool.set_velocity(velocity);
    contact.load(tool, kSample, load);
    const Vector3d held = load.extra + load.shake;
    Vector3d force = load.walls + held;
    if (!(force.norm() < 1e3)) force *= 1e3 / force.norm();
    const Vector3d& prey = held.isZero() ? force : held;
    const Vector3d dx = motion(random, i, prey, device, kSample, 2e-5);
    device += dx;
    velocity = dx / kSample;
    books.settle(force, dx, kSample);
    tool.move({device});
    contact.settle(tool, kSample, rich);
    const double left = books.energy - contact.walls().stored() - contact.regions().stored();
    most = std::max(most, left);
    made = std::max(made, most - left);
  }
  return made;
}

}  // namespace reckon::haptics::adversary
