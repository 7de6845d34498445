// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A mass on a spring with viscosity and its weight (thesis 5.1 to 5.3), over the whole range of the
// thesis: equal to the closed form, or refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "reckon/haptics/bodies/body_push.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::spring_body_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kT = 1e-3;     // [s]
constexpr double kDrop = 1e-3;  // [m], from rest at the spring's end
constexpr double kG = 9.81;

struct Case {
  double stiffness, mass, viscosity;
};

Scene ball_of(double mass) {
  Scene scene;
  scene.gravity = {0, 0, -kG};
  SceneObject& ball = scene.objects.emplace_back();
  ball.name = "ball";
  ball.shape = SphereShape{0.02};
  ball.matter.mass = mass;
  return scene;
}

/// x'' = -K/m x - c/m x' - g from x(0) = kDrop at this speed.
double place_at(const Case& at, double speed, double t) {
  using Complex = std::complex<double>;
  const double rest = -at.mass * kG / at.stiffness;
  const double half = 0.5 * at.viscosity / at.mass;
  const Complex root = std::sqrt(Complex(half * half - at.stiffness / at.mass));
  const Complex one = -half + root, other = -half - root;
  const double from = kDrop - rest;
  const Complex a = (speed - other * from) / (one - other);
  return rest + (a * std::exp(one * t) + (from - a) * std::exp(other * t)).real();
}

struct Swing {
  double error = 0.0;  // greatest position error [m]
  double way = 0.0;    // greatest displacement [m]
  double made = 0.0;   // share of the greatest energy
};

// A resting hand holds the ball.
Swing swing_of(const Case& at) {
  const Scene scene = ball_of(at.mass);
  const EffectPlan plan(scene);
  BodyWorld world(plan, scene.gravity);
  const std::size_t hand = world.add_hand();
  nanoseconds now{1'000'000'000};
  world.advance_to(now);
  const double two_swings = 4 * std::numbers::pi * std::sqrt(at.mass / at.stiffness);
  const double begun = 0.5 * at.stiffness * kDrop * kDrop;
  const auto pull = [&](double x, double v) {
    return -(at.stiffness * x + at.viscosity * v) / at.mass - kG;
  };
  double speed = 0.0;
  Swing out;
  for (int i = 0; i < 3000; ++i) {
    const BodyState& body = world.states()[0];
    const double x = kDrop + body.position.z();
    // The velocity is half a step older than the position, also at the start.
    if (i == 1) speed = 0.5 * body.step * pull(kDrop, 0.0);
    const double v = body.velocity.z() + 0.5 * body.step * pull(x, body.velocity.z());
    const double energy =
        0.5 * at.mass * v * v + at.mass * kG * (x - kDrop) + 0.5 * at.stiffness * x * x;
    if (i > 0) out.made = std::max(out.made, energy - begun);
    if (i > 0 && i * kT < two_swings)
      out.error = std::max(out.error, std::abs(x - place_at(at, speed, i * kT)));
    out.way = std::max(out.way, std::abs(x - kDrop));
    BodySpring spring;
    spring.point = body.position;
    spring.force.z() = -at.stiffness * x;
    spring.normal = Vector3d::UnitZ();
    spring.stiffness = at.stiffness;
    spring.grips = true;
    spring.viscosity = at.viscosity;
    spring.drag = -at.viscosity * body.velocity;
    const std::size_t push = world.press(hand, spring);
    world.foresee(hand, kT);
    world.hold(push, 1.0, Vector3d::Zero());
    world.written(hand, {});
    world.advance_to(now += nanoseconds(1'000'000));
  }
  out.made /= std::max(begun, at.mass * kG * out.way);
  return out;
}

bool is_refused(const Case& at) {
  Scene scene = ball_of(at.mass);
  scene.objects[0].effects.of<SpringDamper>() = {at.stiffness, 0.0};
  const auto plan = std::make_shared<const EffectPlan>(scene);
  SimulatedDevice device(SimulatedDeviceConfig{}, [](double) { return HandTarget{}; });
  try {
    ServoLoop(device, plan, ServoConfig{}, std::make_shared<BodyWorld>(*plan, scene.gravity));
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("body 'ball'"), std::string::npos) << error.what();
    return true;
  }
  return false;
}

// Position within 1 % of the displacement in the first two swings, energy within 0.3 % for up to
// 900.
TEST(SpringBody, OscillatesAsTheClosedFormOrIsRefused) {
  int shown = 0;
  for (int k = 0; k <= 6; ++k) {
    for (int m = -3; m <= 3; ++m) {
      Case at{std::pow(10.0, k), std::pow(10.0, m), 0.0};
      const std::string name = "K 1e" + std::to_string(k) + ", m 1e" + std::to_string(m);
      const bool fits = at.stiffness <= stiffest_push(at.mass, kT);
      EXPECT_EQ(is_refused(at), !fits) << name;
      if (!fits) continue;
      ++shown;
      for (const double damped : {0.0, 0.02}) {
        // In a gate only one of both, alternating.
        if (!test::soaks() && (damped > 0.0) != ((k + m) % 2 == 0)) continue;
        at.viscosity = damped * at.mass / kT;
        const Swing swing = swing_of(at);
        EXPECT_LT(swing.error, 0.01 * swing.way) << name;
        EXPECT_LT(swing.made, 0.003) << name;
      }
    }
  }
  EXPECT_EQ(shown, 43);
}

}  // namespace
}  // namespace reckon::haptics::spring_body_test
