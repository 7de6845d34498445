// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand that extracts energy from effects: half the time it makes the motion that takes most out
// of the held force. Samples come late, and the force is cut now and then.
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

/// The energy port of a hand in a scene. A test moves the hand; the device keeps the energy ledger.
class BookedPort {
 public:
  /// @param place of the hand [m]  @param delay [samples], of the device
  BookedPort(const EffectPlan& plan, const Vector3d& place, int delay = 0)
      : port_(kDamping, delay),
        contact_(plan, 0.75 * 0.95 * 2.0 * kDamping / (kSample * (1.0 + 2.0 * delay))),
        held_(delay),
        place_(place) {
    tool_.reset({place});
    contact_.reset(tool_);
  }

  /// The force for the next sample [N].
  const Vector3d& hold() {
    PortLoad load;
    tool_.set_velocity(velocity_);
    contact_.load(tool_, kSample, load);
    const PortHold held = port_.hold(load, kSample);
    if (held.walls < 1.0) contact_.attenuate(held.walls, port_);
    contact_.shown(held.extra);
    return force_ = held.force + port_.shake(load, kSample);
  }
  void cut(double to) {
    contact_.attenuate(to, port_);
    port_.attenuate(to);
    force_ *= to;
  }
  /// The hand moves by `dx` [m] under the force at the handle.
  void move(const Vector3d& dx, double dt = kSample) {
    hold_for_a_sample(dx, dt);
    port_.settle(unread_, dt);
    tool_.move({place_});
    contact_.settle(tool_, dt, port_);
    unread_.setZero();
  }
  /// The reading after the motion fails, and the next force is cut.
  void move_unread(const Vector3d& dx) {
    hold_for_a_sample(dx, kSample);
    port_.miss(kSample);
    hold();
    cut(0.0);
  }

  [[nodiscard]] EnergyPort& port() { return port_; }
  [[nodiscard]] StaticContact& contact() { return contact_; }
  [[nodiscard]] const Vector3d& place() const { return place_; }
  [[nodiscard]] const Vector3d& at_handle() const { return held_.at_handle(); }
  /// Whether the last sample was read. An unread sample is booked with the next.
  [[nodiscard]] bool is_read() const { return unread_.isZero(0.0); }
  /// Since the start [J].
  [[nodiscard]] double energy() const { return energy_; }
  [[nodiscard]] double least() const { return least_; }

 private:
  void hold_for_a_sample(const Vector3d& dx, double dt) {
    held_.write(force_);
    energy_ += -held_.at_handle().dot(dx) + kDamping * dx.squaredNorm() / dt;
    least_ = std::min(least_, energy_);
    place_ += dx;
    unread_ += dx;
    velocity_ = dx / dt;
  }

  EnergyPort port_;
  StaticContact contact_;
  PointTool tool_;
  HeldForces held_;
  Vector3d place_, velocity_ = Vector3d::Zero(), force_ = Vector3d::Zero();
  Vector3d unread_ = Vector3d::Zero();
  double energy_ = 0.0, least_ = 0.0;
};

/// The motion of the hand in a sample: the one that takes most out of `force`, or a random one.
/// @param stray [m] of the latter
inline Vector3d motion(Random& random, int step, const Vector3d& force, const Vector3d& device,
                       double dt, double stray) {
  std::normal_distribution<double> normal;
  Vector3d dx = stray * Vector3d(normal(random), normal(random), normal(random));
  if (step % 2 == 0) dx = 0.5 * dt / kDamping * force;
  if (dx.norm() > 0.002) dx *= 0.002 / dx.norm();
  return dx + 0.004 * (Vector3d(0.015, 0.012, 0.012) - device);
}

/// With the gate: the least value of the ledger, and the energy that late samples explain.
struct Least {
  double books, late;
};
[[nodiscard]] inline Least run_gated(const Scene& scene, Random& random, double stray = 2e-4) {
  const EffectPlan plan(scene);
  BookedPort port(plan, {0.03, 0.02, 0.025});
  for (int i = 0; i < kSteps; ++i) {
    Vector3d force = port.hold();
    if (i % 97 == 0) {
      port.cut(0.5);
      force *= 0.5;
    }
    const double dt = random() % 20 == 0 ? any(random, 1.0, 4.0) * kSample : kSample;
    port.move(motion(random, i, force, port.place(), dt, stray), dt);
    EXPECT_TRUE(force.allFinite()) << i;
  }
  return {port.least(), port.port().late_cost()};
}

/// A hand that puts in almost no energy in a region: it strays by microns about `start` [m, S],
/// then follows the force, by the step that takes most out or by a random one. @return least of the
/// ledger [J]
[[nodiscard]] inline double stray_and_let_go(const EffectPlan& plan, const Vector3d& start,
                                             Random& random) {
  BookedPort port(plan, start);
  int stray = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d& force = port.hold();
    Vector3d dx =
        Vector3d(any(random, -4e-6, 4e-6), any(random, -4e-6, 4e-6), any(random, -4e-6, 4e-6));
    if (stray-- <= 0) {
      dx = any(random, 0.2, 1.0) * kSample / kDamping * force;
      if (stray < -30) {
        stray = static_cast<int>(any(random, 1.0, 60.0));
        dx = 0.2 * (start - port.place());
      }
    }
    port.move(dx);
  }
  return port.least();
}

/// A hand that puts in almost no energy: it presses by microns from exactly the surface and
/// releases by the step that takes most out. @param plan its first object is a box of 40 mm @return
/// least value of the ledger [J]
[[nodiscard]] inline double press_and_let_go(const EffectPlan& plan, Random& random) {
  const PlannedObject& object = plan.objects()[0];
  const Vector3d start = object.to_scene({0.003, 0.001, 0.02 + 1e-6});
  const Vector3d in = object.orientation * Vector3d(0, 0, -1);
  BookedPort port(plan, start);
  int press = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d& force = port.hold();
    Vector3d dx = any(random, 0.0, 4e-6) * in;
    if (press-- <= 0) {
      dx = 0.5 * kSample / kDamping * force;
      if (press < -3) {
        press = static_cast<int>(any(random, 1.0, 60.0));
        dx = 0.2 * (start - port.place());
      }
    }
    port.move(dx);
  }
  return port.least();
}

/// The greatest fall of the hand's input beyond the energy of springs [J]: the energy that effects
/// made. The hand exploits the effects' addition to the surface, where there is one.
[[nodiscard]] inline double made_open(const Scene& scene, Random& random) {
  const EffectPlan plan(scene);
  EnergyPort rich(1e12);  // without any limit
  StaticContact contact(plan, 1e12);
  PointTool tool;
  Vector3d device(0.03, 0.02, 0.025), velocity = Vector3d::Zero();
  tool.reset({device});
  contact.reset(tool);
  double energy = 0.0, most = 0.0, made = 0.0;
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
    energy += -force.dot(dx) + kDamping * dx.squaredNorm() / kSample;
    tool.move({device});
    contact.settle(tool, kSample, rich);
    const double left = energy - contact.walls().stored() - contact.regions().stored();
    most = std::max(most, left);
    made = std::max(made, most - left);
  }
  return made;
}

}  // namespace reckon::haptics::adversary
