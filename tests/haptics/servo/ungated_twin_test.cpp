// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand without the gate: equal to the gated one without delay, unstable with delay.
#include "reckon/haptics/servo/ungated_twin.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>
#include <memory>

#include "reckon/haptics/devices/pointer_device.hpp"
#include "reckon/tests/haptics/support/pointer_play.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics {
namespace {

using bench::only;
using bench::sphere;
using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

std::shared_ptr<const EffectPlan> plan_of(const Scene& scene = {}) {
  return std::make_shared<const EffectPlan>(scene);
}

/// A twin with a real hand at a position set by the test.
struct Alone {
  explicit Alone(const Scene& scene = {}, SimulatedDeviceConfig config = {}, HandScript script = {})
      : device(config, std::move(script)), twin(device, plan_of(scene), {}) {}
  void step(const Vector3d& real = Vector3d::Zero(), nanoseconds period = 1ms) {
    now += period;
    twin.step({now, real, Vector3d::Zero()});
  }
  SimulatedDevice device;
  UngatedTwin twin;
  nanoseconds now{0};
};

/// The servo and its twin with one operator, each on its own device.
struct Beside {
  Beside(const Scene& scene, const SimulatedDeviceConfig& config, const HandScript& script)
      : real(scene, config, script), device(config, script), twin(device, plan_of(scene), {}) {}
  void step() {
    const ServoSnapshot& step = real.run(1ms);
    twin.step({step.time, step.device, step.device_velocity});
  }
  [[nodiscard]] double felt() { return real.servo.snapshots().read().force.norm(); }
  bench::Bench real;
  SimulatedDevice device;
  UngatedTwin twin;
};

TEST(UngatedTwin, FeelsASlowPressLikeItsHand) {
  // A floor of 800 N/m, and a hand of 500 N/m at rest above another one.
  for (const bool on_floor : {true, false}) {
    Beside pair(on_floor ? bench::floor(800) : Scene{}, bench::at(on_floor ? 0.03 : 0.06),
                bench::presses(on_floor ? 0.005 : -0.02, on_floor ? 0.03 : 0.06));
    if (!on_floor) {
      pair.real.servo.contacts().write(only(sphere(Vector3d::Zero(), 500)));
      pair.twin.take(only(sphere(Vector3d::Zero(), 500)));
    }
    double most = 0, most_off = 0;
    for (int i = 0; i < 3000; ++i) {
      pair.step();
      most = std::max(most, pair.felt());
      most_off = std::max(most_off, std::abs(pair.twin.force().norm() - pair.felt()));
    }
    std::printf("%.2f N, %.4f N off\n", most, most_off);
    EXPECT_GT(most, 0.8) << on_floor;
    EXPECT_LT(most_off, 0.005) << on_floor;
    EXPECT_GE(pair.twin.energy(), 0) << on_floor;
    EXPECT_EQ(pair.twin.resets(), 0U);
  }
}

/// Two twins that press each other with 2 N, each with the other's motion of `delay` ago, dead
/// reckoned from there.
class Pair {
 public:
  explicit Pair(nanoseconds delay) : delay_(delay) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double side = i == 0 ? 1.0 : -1.0;
      SimulatedDeviceConfig config;
      config.hand_stiffness = 300;
      config.start.x() = -side * 0.02;
      devices_.at(i) = std::make_unique<SimulatedDevice>(config, [side](double t) {
        HandTarget hand;
        const double way = std::min(1.0, t);
        hand.position.x() = side * (-0.02 + 0.0187 * way * way * (3 - 2 * way));
        return hand;
      });
      twins_.at(i) = std::make_unique<UngatedTwin>(*devices_.at(i), plan_of(), ServoConfig{});
    }
  }

  void run(nanoseconds duration) {
    for (const nanoseconds end = now_ + duration; now_ < end;) {
      now_ += 1ms;
      for (std::size_t i = 0; i < 2; ++i) hear(i);
      for (std::size_t i = 0; i < 2; ++i) {
        const double home = i == 0 ? -0.01 : 0.01;
        twins_.at(i)->step({now_, Vector3d(home, 0, 0), Vector3d::Zero()});
        told_.at(i).push_back(twins_.at(i)->motion());
      }
      const double force = twin(0).force().norm();
      least_ = std::min(least_, force);
      most_ = std::max(most_, force);
      least_energy_ = std::min(least_energy_, twin(0).energy());
      least_sum_ = std::min(least_sum_, twin(0).energy() + twin(1).energy());
    }
  }
  void forget() { least_ = 1e9, most_ = 0; }

  [[nodiscard]] const UngatedTwin& twin(std::size_t i) const { return *twins_.at(i); }
  [[nodiscard]] double swing() const { return most_ - least_; }
  [[nodiscard]] double least_energy() const { return least_energy_; }
  [[nodiscard]] double least_sum() const { return least_sum_; }

 private:
  void hear(std::size_t i) {
    auto& told = told_.at(1 - i);
    if (told.empty() || told.front().time + delay_ > now_) return;
    while (told.size() > 1 && told.at(1).time + delay_ <= now_) told.pop_front();
    RemoteHand other = sphere(told.front().position, 500);
    other.model.radius = 0.01;
    other.state.velocity = told.front().velocity;
    other.state_time = told.front().time;
    twins_.at(i)->take(only(other));
  }

  nanoseconds delay_, now_{0};
  std::array<std::unique_ptr<SimulatedDevice>, 2> devices_;
  std::array<std::unique_ptr<UngatedTwin>, 2> twins_;
  std::array<std::deque<HandMotion>, 2> told_;
  double least_ = 1e9, most_ = 0, least_energy_ = 0, least_sum_ = 0;
};

TEST(UngatedTwin, PressesAnotherCalmlyWithoutDelay) {
  Pair pair(0ms);
  pair.run(2s);
  pair.forget();
  pair.run(2s);
  EXPECT_NEAR(pair.twin(0).force().norm(), 2.0, 0.02);
  EXPECT_LT(pair.swing(), 0.01);
  EXPECT_GE(pair.least_sum(), -1e-4);
  EXPECT_EQ(pair.twin(0).resets(), 0U);
}

TEST(UngatedTwin, ShakesAndMakesEnergyOverADelay) {
  for (const nanoseconds delay : {150ms, 300ms}) {
    Pair pair(delay);
    pair.run(4s);
    std::printf("%lld ms: swing %.1f N, energy %.3f J\n", static_cast<long long>(delay / 1ms),
                pair.swing(), pair.least_energy());
    EXPECT_GT(pair.swing(), 5.0);
    EXPECT_LT(pair.least_energy(), -0.05);
    EXPECT_LT(pair.least_sum(), -0.05);
  }
}

TEST(UngatedTwin, RestartsAtTheRealHandBeyondDeviceForce) {
  Alone one;
  one.step();
  EXPECT_TRUE(one.twin.feels());
  one.twin.take(only(sphere({0.02, 0, 0}, 1e6)));
  const Vector3d real(0.03, 0.01, 0.0);
  one.step(real);
  EXPECT_FALSE(one.twin.feels());
  EXPECT_EQ(one.twin.resets(), 1U);
  EXPECT_EQ(one.twin.force().norm(), 0);
  EXPECT_EQ(one.twin.energy(), 0);
  one.twin.take({});
  for (auto t = 0ms; t < UngatedTwin::kAside - 1ms; t += 1ms) one.step(real);
  EXPECT_FALSE(one.twin.feels());
  one.step(real);
  EXPECT_TRUE(one.twin.feels());
  EXPECT_EQ(one.twin.motion().position, real);
  EXPECT_EQ(one.twin.resets(), 1U);
}

TEST(UngatedTwin, IsLostFarFromTheRealHand) {
  Alone one;
  one.step();
  one.step({UngatedTwin::kFarthest + 0.001, 0, 0});
  EXPECT_EQ(one.twin.resets(), 1U);
}

TEST(UngatedTwin, SurvivesNonFiniteModelsAndStates) {
  using Limits = std::numeric_limits<double>;
  for (const double bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), 1e300}) {
    for (int field = 0; field < 6; ++field) {
      Alone one;
      one.step();
      RemoteHand hand = sphere({0.02, 0, 0}, 500);
      (field == 0   ? hand.model.k1
       : field == 1 ? hand.model.k3
       : field == 2 ? hand.model.damping
       : field == 3 ? hand.model.radius
       : field == 4 ? hand.state.position.x()
                    : hand.state.velocity.y()) = bad;
      one.twin.take(only(hand));
      for (int i = 0; i < 2000; ++i) {
        one.step();
        ASSERT_TRUE(one.twin.force().allFinite());
        ASSERT_LE(one.twin.force().norm(), 10.0);
        ASSERT_TRUE(one.twin.motion().position.allFinite());
        ASSERT_TRUE(std::isfinite(one.twin.energy()));
      }
      EXPECT_LE(one.twin.resets(), 2000U / 500U);
      one.twin.take({});
      for (int i = 0; i < 600; ++i) one.step();
      EXPECT_TRUE(one.twin.feels());
    }
  }
}

TEST(UngatedTwin, IgnoresAnExpiredModel) {
  Alone one;
  RemoteHand hand = sphere({0.025, 0, 0}, 500);
  hand.valid_until = 5ms;
  one.twin.take(only(hand));
  one.step();
  EXPECT_GT(one.twin.force().norm(), 1.0);
  one.step({}, 5ms);
  EXPECT_EQ(one.twin.force().norm(), 0);
}

TEST(UngatedTwin, HoldsThePredictionWhileTheSimulationIsFrozen) {
  RemoteHand hand = sphere({0.025, 0, 0}, 500);
  hand.state.velocity.x() = 1.0;
  SimulatedDeviceConfig stiff;
  stiff.hand_stiffness = 1e5;
  Alone one({}, stiff);
  ContactSet set = only(hand);
  one.twin.take(set);
  one.step();
  const double before = one.twin.force().norm();
  set.frozen = true;
  one.twin.take(set);
  one.step();
  EXPECT_NEAR(one.twin.force().norm(), before, 0.1);
  set.frozen = false;
  one.twin.take(set);
  one.step();
  EXPECT_LT(one.twin.force().norm(), before - 0.5);
}

TEST(UngatedTwin, IntegratesNothingOfAGap) {
  int calls = 0;
  Alone one({}, {}, [&calls](double) {
    ++calls;
    return HandTarget{};
  });
  one.step();
  calls = 0;
  one.step({0.05, 0, 0}, 1h);
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(one.twin.motion().position.x(), 0.05);
  one.step({0.05, 0, 0});
  EXPECT_GT(calls, 0);
  EXPECT_LE(calls, 20);
  EXPECT_EQ(one.twin.resets(), 0U);
}

TEST(UngatedTwin, IgnoresAStepThatIsNotLater) {
  Alone one;
  one.step();
  one.step();
  const Vector3d before = one.twin.motion().position;
  one.twin.step({one.now - 1ms, Vector3d::Constant(1.0), Vector3d::Zero()});
  one.twin.step({one.now, Vector3d::Constant(1.0), Vector3d::Zero()});
  EXPECT_EQ(one.twin.motion().position, before);
  EXPECT_EQ(one.twin.resets(), 0U);
}

TEST(UngatedTwin, StaysFiniteForAnyPointerPath) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    PointerDevice device({}, 0.5);
    UngatedTwin twin(device, plan_of(bench::floor(800)), {});
    twin.take(only(sphere({0.03, 0, 0}, seed % 2 == 0 ? 500 : 5000)));
    PointerPlay play(seed);
    for (int i = 1; i <= 1500; ++i) {
      play.at(i, [&](const PointerSample& sample) { device.inbox().put(sample); });
      twin.step({i * 1ms, device.position(), device.velocity()});
      ASSERT_TRUE(twin.force().allFinite()) << "seed " << seed;
      ASSERT_LE(twin.force().norm(), 10.0) << "seed " << seed;
      ASSERT_TRUE(twin.motion().position.allFinite()) << "seed " << seed;
      ASSERT_TRUE(std::isfinite(twin.energy())) << "seed " << seed;
    }
  }
}

// A pointer that holds while its twin pauses holds it afterwards too.
TEST(UngatedTwin, KeepsItsOperatorWhilePaused) {
  PointerDevice device({}, 0.5), real({}, 0.5);
  UngatedTwin twin(device, plan_of(), {});
  for (int i = 1; i <= 1200; ++i) {
    if (i % 16 == 0) {
      device.inbox().put({{0.05, 0, 0}, true});
      real.inbox().put({{0.05, 0, 0}, true});
    }
    const DeviceSample sample = real.read(i * 1ms);
    if (i == 400) twin.take(only(sphere(sample.position, 1e6)));
    if (i == 401) twin.take({});
    twin.step({i * 1ms, sample.position, sample.velocity});
    EXPECT_EQ(device.grip(), real.grip()) << i;
    EXPECT_EQ(device.path().position(), real.path().position()) << i;
  }
  EXPECT_EQ(twin.resets(), 1U);
  EXPECT_TRUE(twin.feels());
  EXPECT_NEAR((device.position() - real.position()).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace reckon::haptics
