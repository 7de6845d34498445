// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An admittance device behind the servo: its feel, and the hand's energy from it, by the ledger of
// its own plant.
#include "reckon/haptics/devices/virtual_handle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_motion.hpp"
#include "reckon/tests/haptics/support/drawn_touch.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::virtual_handle_test {
namespace {

using bench::Bench;
using bench::presses;
using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

/// A servo on such a device.
struct Stand {
  Stand(const Scene& scene, const SimulatedMotionConfig& device, HandScript script,
        VirtualHandleConfig config = {})
      : motion(device, std::move(script)),
        handle(motion, with_hold(config)),
        plan(std::make_shared<const EffectPlan>(scene)),
        servo(handle, plan, {}, make_bodies(*plan, scene)) {}

  static VirtualHandleConfig with_hold(VirtualHandleConfig config) {
    config.hold = 1500us;
    return config;
  }
  const ServoSnapshot& step(nanoseconds period = 1ms) {
    servo.step(now);
    servo.snapshots().update();
    const ServoSnapshot& snapshot = servo.snapshots().read();
    least =
        std::min(least, motion.handle_work() + handle.written_off() + test::transferred(snapshot));
    port = std::min(port, snapshot.port_energy + snapshot.loan + snapshot.source_energy());
    now += period;
    return snapshot;
  }
  void run(nanoseconds duration) {
    for (const nanoseconds end = now + duration; now < end;) step();
  }

  SimulatedMotion motion;
  VirtualHandle handle;
  std::shared_ptr<const EffectPlan> plan;
  ServoLoop servo;
  nanoseconds now{0};
  double least = 0.0, port = 0.0;  // [J]
};

SimulatedMotionConfig device(MotionLoop loop = MotionLoop::position, double grip = 300.0) {
  SimulatedMotionConfig config;
  config.loop = loop;
  config.hand_stiffness = grip;
  config.start.z() = 0.01;
  return config;
}

constexpr auto kLoops = {MotionLoop::position, MotionLoop::velocity};

// Of the motors, against a force on the handle [N/m].
double motor_stiffness(const SimulatedMotionConfig& config) {
  const double fast = 2.0 * std::numbers::pi * config.bandwidth;
  return (config.loop == MotionLoop::position ? 1.0 : 0.25) * config.mass * fast * fast;
}

// The series of springs that a hand compresses by 10 mm: two for an impedance device; an admittance
// device adds its sensor and its motors.
TEST(VirtualHandle, WallFeelsAsOnAnImpedanceDevice) {
  for (const MotionLoop loop : kLoops) {
    for (const double wall : {500.0, 2000.0}) {
      const Scene scene = bench::floor(wall, 0.0);
      SimulatedDeviceConfig plain = bench::at(0.01);
      plain.hand_stiffness = 300.0;
      plain.damping = 2.0;
      Bench impedance(scene, plain, presses(0.01, 0.01));
      const double force = impedance.run(4s).force.z();
      EXPECT_NEAR(force, 0.01 / (1 / 300.0 + 1 / wall), 1e-3);

      const SimulatedMotionConfig config = device(loop);
      Stand stand(scene, config, presses(0.01, 0.01));
      stand.run(9s);
      const double felt = stand.motion.force().z();
      const double springs =
          1 / 300.0 + 1 / wall + 1 / config.sensor_stiffness + 1 / motor_stiffness(config);
      EXPECT_NEAR(-felt, 0.01 / springs, 0.003 * force);
      EXPECT_LT(std::abs(-felt * springs / (1 / 300.0 + 1 / wall) - force), 0.01 * force);
      EXPECT_NEAR(stand.servo.snapshots().read().force.z(), -felt, 0.005);
      EXPECT_LT(stand.motion.velocity().norm(), 0.002) << "stable";
      EXPECT_EQ(stand.handle.heavier(), 0U);
      EXPECT_GE(stand.port, -1e-9);
      EXPECT_GE(stand.least, -1e-9);
    }
  }
}

// If the hand ignores the position, the mass obeys m v' = f - b v, at any rate.
TEST(VirtualHandle, MovesAsADampedMassAtAnyRate) {
  class Pushed final : public MotionDevice {
   public:
    Vector3d at = Vector3d::Zero();
    [[nodiscard]] MotionLimits limits() const noexcept override {
      return {10.0, 5.0, Vector3d::Constant(-10), Vector3d::Constant(10)};
    }
    [[nodiscard]] MotionSample read(nanoseconds) noexcept override {
      MotionSample sample;
      sample.ok = true;
      sample.position = at;
      sample.force = {0.0, 1.5, 0.0};
      return sample;
    }
    void command(const Vector3d& position, const Vector3d&, nanoseconds) noexcept override {
      at = position;
    }
  };
  for (const nanoseconds period : {nanoseconds(100us), nanoseconds(1ms), nanoseconds(8ms)}) {
    Pushed pushed;
    VirtualHandle handle(pushed, {3.0, 2.0, 0.0, 1.0});
    nanoseconds now{0};
    for (; now <= 400ms; now += period) {
      const DeviceSample sample = handle.read(now);
      const double t = 1e-9 * static_cast<double>(now.count()), rate = 2.0 / 3.0;
      const double way = 0.75 * (t - (1 - std::exp(-rate * t)) / rate);
      ASSERT_NEAR(sample.position.y(), way, 1e-12);
      ASSERT_NEAR(sample.velocity.y(), 0.75 * (1 - std::exp(-rate * t)), 1e-12);
      handle.write(Vector3d::Zero(), now);
    }
  }
}

// Masses, grips, loops, walls, friction, delays: beyond the written-off energy the hand gets at
// most the loan, and the device's own motion while the mass rests. RECKON_SOAK=1 draws 1,000.
TEST(VirtualHandle, GivesAtMostALoanForAnyDevice) {
  const unsigned seeds = test::tries(24U, 1000U);
  unsigned heavier = 0;
  double lowest = 0.0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937_64 random(seed);
    const auto within = [&](double least, double most) {
      return std::uniform_real_distribution<double>(least, most)(random);
    };
    const auto scale = [&](double least, double most) {
      return std::exp(within(std::log(least), std::log(most)));
    };
    SimulatedMotionConfig config =
        device(seed % 2 == 0 ? MotionLoop::position : MotionLoop::velocity, scale(30, 5000));
    config.delay_samples = static_cast<int>(within(0, 7));
    config.bandwidth = scale(5, 100);
    config.mass = scale(0.5, 20);
    config.sensor_stiffness = scale(2e3, 50e3);
    config.hand_damping = within(0.1, 2) * std::sqrt(0.2 * config.hand_stiffness);
    const double way = scale(0.002, 0.04), fast = scale(0.5, 30), middle = within(-0.02, 0.02);
    const HandScript script = [=](double t) {
      HandTarget hand;
      hand.position = {0.01 * std::sin(2.3 * fast * t), 0, middle + way * std::cos(fast * t)};
      return hand;
    };
    Scene scene = bench::floor(scale(50, 5000), within(0, 1));
    if (seed % 3 == 0) scene.objects[0].effects.of<StickSlipFriction>() = {0.5, 0.3};
    VirtualHandleConfig mass;
    mass.mass = scale(0.1, 5);
    mass.damping = scale(0.3, 10);
    Stand stand(scene, config, script, mass);
    stand.run(4s);
    EXPECT_GE(stand.least, -2.2 * mass.loan) << seed;
    EXPECT_GE(stand.port, -1e-9) << seed << ": the mass is passive";
    EXPECT_LE(stand.handle.written_off(),
              3.0 * mass.loan * static_cast<double>(stand.handle.heavier()))
        << seed;
    heavier += stand.handle.heavier() > 0 ? 1U : 0U;
    lowest = std::min(lowest, stand.least);
  }
  std::printf("least %.3g J beside what was written off; %u of %u became heavier\n", lowest,
              heavier, seeds);
  EXPECT_GT(heavier, seeds / 3) << "the scenes are easy";
  EXPECT_LT(heavier, seeds);
}

// Walls, remote hands, effects, bodies.
TEST(VirtualHandle, GivesAtMostALoanForAnyTouch) {
  for (const test::TouchKind kind : test::kTouchKinds) {
    double most = 0.0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      test::DrawnTouch touch(kind, seed);
      SimulatedMotionConfig config =
          device(seed % 2 == 0 ? MotionLoop::position : MotionLoop::velocity, 100.0 * seed);
      config.start = touch.hand(0);
      config.delay_samples = static_cast<int>(seed % 5);
      Stand stand(touch.scene(), config, [&](double t) {
        HandTarget hand;
        hand.position = touch.hand(t);
        return hand;
      });
      for (int i = 0; i < 5000; ++i) {
        touch.play_others(stand.servo, stand.now);
        most = std::max(most, stand.step().force.norm());
      }
      EXPECT_GE(stand.least, -2.2 * VirtualHandleConfig{}.loan)
          << static_cast<int>(kind) << ' ' << seed;
      EXPECT_GE(stand.port, -1e-9) << static_cast<int>(kind) << ' ' << seed;
      EXPECT_LE(stand.handle.heavier(), 10U) << static_cast<int>(kind) << ' ' << seed;
    }
    EXPECT_GT(most, 1.0) << static_cast<int>(kind);
  }
}

// 200 g behind 30 Hz oscillate with a hand of 300 N/m: the plain loop diverges. The mass increases,
// and the wall is correct.
TEST(VirtualHandle, IncreasesItsMassOnTooSlowADevice) {
  for (const int delay : {0, 5}) {
    SimulatedMotionConfig config = device();
    config.delay_samples = delay;
    VirtualHandleConfig mass;
    mass.mass = 0.2;
    mass.damping = 2.0;
    Stand stand(bench::floor(500.0, 0.0), config, presses(0.01, 0.01), mass);
    double fastest = 0.0, force = 0.0;
    int steps = 0;
    for (; stand.now < 8s;) {
      stand.step();
      fastest = std::max(fastest, stand.motion.velocity().norm());
      if (stand.now < 6s) continue;
      force += stand.motion.force().z();
      ++steps;
    }
    EXPECT_NEAR(-force / steps, 1.8576, 0.02) << delay;
    EXPECT_LT(fastest, 0.3);
    EXPECT_GE(stand.handle.heavier(), 1U);
    EXPECT_LE(stand.handle.heavier(), 8U);
    EXPECT_GE(stand.least, -2.0 * mass.loan);
  }
}

// The mass of a device of defaults is the scene's.
TEST(VirtualHandle, KeepsItsMassWithUsualGrips) {
  for (const MotionLoop loop : kLoops) {
    for (const double grip : {50.0, 200.0, 500.0}) {
      Stand stand(bench::floor(2000.0, 0.0), device(loop, grip), [](double t) {
        HandTarget hand;
        hand.position.z() = 0.02 * std::cos(5.0 * t);
        hand.position.x() = 0.02 * std::sin(4.0 * t);
        return hand;
      });
      stand.run(5s);
      EXPECT_EQ(stand.handle.heavier(), 0U) << grip;
      EXPECT_EQ(stand.handle.mass(), 2.0);
    }
  }
}

// In free space a hand feels the damping, and the mass while accelerating; nothing else.
TEST(VirtualHandle, FeelsLikeItsDampingInFreeSpace) {
  SimulatedMotionConfig config = device();
  config.workspace = {Vector3d::Constant(-1), Vector3d::Constant(1)};
  Stand stand({}, config, [](double t) {
    HandTarget hand;
    hand.position = {0.1 * t, 0, 0.01};
    hand.velocity = {0.1, 0, 0};
    return hand;
  });
  stand.run(6s);
  EXPECT_NEAR(stand.motion.velocity().x(), 0.1, 1e-3);
  EXPECT_NEAR(stand.motion.force().x(), 0.2, 2e-3) << "2 N s/m at 0.1 m/s";
}

TEST(VirtualHandle, StaysInTheWorkSpaceOfItsDevice) {
  Stand stand({}, device(), [](double) {
    HandTarget hand;
    hand.position = {0.06, -0.07, 0.0};
    return hand;
  });
  stand.run(6s);
  EXPECT_NEAR(stand.motion.position().x(), 0.05, 2e-3);
  EXPECT_NEAR(stand.motion.position().y(), -0.05, 2e-3);
  EXPECT_LT(stand.motion.velocity().norm(), 1e-3);
}

// Cable out and in, switch off and on, a step that comes much too late: the device stops, and
// continues from its position.
TEST(VirtualHandle, StopsWithoutSwitchOrReading) {
  for (int what = 0; what < 3; ++what) {
    Stand stand(bench::floor(500.0, 0.0), device(), presses(0.01, 0.01));
    stand.run(3s);
    if (what == 0) stand.motion.plug(false);
    if (what == 1) stand.motion.enable(false);
    if (what == 2) stand.now += 500ms;
    for (int i = 0; what < 2 && i < 500; ++i) {
      const ServoSnapshot& snapshot = stand.step();
      ASSERT_EQ(snapshot.force.norm(), 0.0) << what << ' ' << i;
    }
    EXPECT_LT(stand.motion.velocity().norm(), 0.01) << what;
    stand.motion.plug(true);
    stand.motion.enable(true);
    stand.run(4s);
    EXPECT_NEAR(-stand.motion.force().z(), 1.8576, 0.02) << what << ": the wall is right again";
    EXPECT_GE(stand.least, -10e-3) << what;
  }
}

TEST(VirtualHandle, DropsTheSceneForceAfterItsHoldTime) {
  Stand stand({}, device(), {});
  static_cast<void>(stand.handle.read(0ms));
  stand.handle.write({0, 0, 5}, 0ms);
  EXPECT_FALSE(stand.handle.read(1500us).watchdog);
  stand.handle.write({0, 0, 5}, 1500us);
  const DeviceSample late = stand.handle.read(6ms);
  EXPECT_TRUE(late.watchdog);
  ASSERT_TRUE(late.released_at.has_value());
  EXPECT_LT(late.released_at->z(), late.position.z()) << "it goes on without";
  stand.handle.write({0, 0, std::nan("")}, 6ms);
  const double before = stand.handle.read(7ms).velocity.z();
  EXPECT_LE(stand.handle.read(8ms).velocity.z(), before) << "what is no number is no force";
}

TEST(VirtualHandle, RefusesParametersOutOfRange) {
  SimulatedMotion motion(device());
  EXPECT_THROW(VirtualHandle(motion, {0.0}), std::invalid_argument);
  EXPECT_THROW(VirtualHandle(motion, {1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(VirtualHandle(motion, {1.0, 1.0, 0.0, -1.0}), std::invalid_argument);
  EXPECT_THROW(VirtualHandle(motion, {1.0, 1.0, 0.0, 0.0, 11ms}), std::invalid_argument);
}

TEST(VirtualHandle, AllocatesNothingWhileItRuns) {
  Stand stand(bench::floor(500.0, 0.0), device(), presses(0.01, 0.01));
  stand.run(100ms);
  const test::AllocationGuard guard;
  stand.run(500ms);
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace reckon::haptics::virtual_handle_test
