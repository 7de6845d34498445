// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device driven by a pointer: how it follows, how it releases, and that no pointer makes energy.
#include "reckon/haptics/devices/pointer_device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>
#include <thread>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/haptics/support/pointer_play.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::pointer_device_test {
namespace {

using bench::kPassive;
using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr double kReach = 0.5;        // [m]
constexpr double kStiffness = 700;    // [N/m], of the floor
constexpr nanoseconds kFrame = 16ms;  // of a web page

SimulatedDeviceConfig held_at(double z) {
  SimulatedDeviceConfig config;
  config.hand_stiffness = 300;
  config.hand_damping = 3;
  config.hold = 1500us;  // like devices of scenes, which release during a late step
  config.start.z() = z;
  return config;
}

/// A servo over a floor at z = 0, on a device driven by a pointer.
class Rig {
 public:
  explicit Rig(double z = 0.03)
      : device(held_at(z), kReach), servo(device, EffectPlan(bench::floor(kStiffness)), {}) {}

  void step(nanoseconds period = 1ms) {
    now += period;
    servo.step(now);
    servo.snapshots().update();
    const double books = device.port_work() + device.damping_loss();
    least = std::min(least, books + snapshot().loan);
    meter_above = std::max(meter_above, snapshot().port_energy - books);
    peak = std::max(peak, device.force().norm());
    fastest = std::max(fastest, device.velocity().norm());
    finite = finite && device.position().allFinite() && device.force().allFinite() &&
             snapshot().force.allFinite() && std::isfinite(snapshot().port_energy);
  }
  /// A pointer rests there for a while.
  void hold(const Vector3d& where, nanoseconds duration) {
    for (const nanoseconds end = now + duration; now < end; step()) {
      if (now % kFrame < 1ms) device.inbox().put({where, true});
    }
  }
  void pass(nanoseconds duration) {
    for (const nanoseconds end = now + duration; now < end;) step();
  }
  [[nodiscard]] const ServoSnapshot& snapshot() { return servo.snapshots().read(); }

  PointerDevice device;
  ServoLoop servo;
  nanoseconds now{0};
  double least = 0, meter_above = 0;  ///< [J]
  double peak = 0, fastest = 0;       ///< [N], [m/s]
  bool finite = true;
};

TEST(PointerDevice, RestsAtItsStartUntilTheFirstSample) {
  Rig rig;
  rig.pass(2s);
  EXPECT_EQ(rig.device.position(), Vector3d(0, 0, 0.03));
  EXPECT_EQ(rig.device.grip(), 1.0);
  EXPECT_FALSE(rig.device.inbox().is_held());
}

TEST(PointerDevice, FollowsAPointerAndPressesInSeries) {
  Rig rig;
  rig.hold({0.1, -0.05, 0.08}, 1s);
  EXPECT_TRUE(rig.device.inbox().is_held());
  EXPECT_LE((rig.device.position() - Vector3d(0.1, -0.05, 0.08)).norm(), 1e-5);
  EXPECT_LE(rig.snapshot().force.norm(), 1e-9);
  rig.hold({0.1, -0.05, -0.01}, 1s);
  EXPECT_NEAR(rig.snapshot().force.z(), 0.01 / (1 / 300.0 + 1 / kStiffness), 1e-3);
}

TEST(PointerDevice, LimitsItsPullForAnyPointerDepth) {
  Rig rig;
  rig.hold({0, 0, -50}, 2s);
  EXPECT_EQ(rig.device.most_pull(), 4.0) << "half of 2 m/s against 4 N s/m";
  EXPECT_NEAR(rig.snapshot().force.z(), 4.0, 1e-3);
  EXPECT_GT(rig.device.position().z(), -0.01);
  EXPECT_EQ(rig.snapshot().trips, 0U);
}

// From a press of 2 N, with and without a release message; without a jolt.
TEST(PointerDevice, ReleasesSmoothlyWithinThreeTenthsOfASecond) {
  for (const bool says_so : {true, false}) {
    Rig rig;
    rig.hold({0, 0, -0.01}, 1s);
    const double pressed = rig.snapshot().force.z();
    ASSERT_GT(pressed, 2.0);
    if (says_so) rig.device.inbox().put({{}, false});
    double last = pressed, jolt = 0;
    for (int i = 0; i < 300; ++i) {
      rig.step();
      const double force = rig.snapshot().force.z();
      jolt = std::max(jolt, std::abs(force - last));
      last = force;
    }
    EXPECT_EQ(rig.device.grip(), 0.0);
    EXPECT_FALSE(rig.device.inbox().is_held());
    EXPECT_LT(jolt, 0.15) << "of " << pressed << " N in a millisecond";
    rig.pass(1s);
    EXPECT_LT(rig.snapshot().force.norm(), 1e-6) << "the wall has pushed it out";
    EXPECT_GE(rig.least, kPassive);
  }
}

TEST(PointerDevice, ReleasesAfterTheLastGoodSample) {
  for (unsigned seed = 1; seed <= test::tries(50U, 200U); ++seed) {
    Rig rig;
    PointerPlay play(seed);
    for (int ms = 0; ms < 500; ++ms) {
      play.at(ms, [&](const PointerSample& sample) { rig.device.inbox().put(sample); });
      rig.step();
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int ms = 0; ms < 300; ++ms) {
      rig.device.inbox().put({{0, nan, 0}, true});  // does not keep it held
      rig.step();
    }
    ASSERT_EQ(rig.device.grip(), 0.0) << seed;
  }
}

// The hand is moved by others meanwhile: the path waits at its position.
TEST(PointerDevice, ResumesAtItsPosition) {
  Rig rig(0.2);
  rig.hold({0, 0, 0.2}, 100ms);
  rig.device.inbox().put({{}, false});
  rig.pass(300ms);
  ContactSet set = bench::only(bench::sphere(Vector3d(0.015, 0, 0.2), 300));
  rig.servo.contacts().write(set);
  rig.pass(1s);
  const Vector3d pushed = rig.device.position();
  ASSERT_GT((pushed - Vector3d(0, 0, 0.2)).norm(), 0.005);
  EXPECT_LE((rig.device.path().position() - pushed).norm(), 1e-3);
  double farthest = 0;
  for (int i = 0; i < 500; ++i) {
    rig.hold(pushed, 1ms);
    farthest = std::max(farthest, (rig.device.position() - pushed).norm());
  }
  EXPECT_LT(farthest, 2e-3);
}

TEST(PointerDevice, CountsRefusedSamplesButAcceptsEveryRelease) {
  PointerDevice device(held_at(0), kReach);
  PointerInbox& inbox = device.inbox();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf, 1e300, -1e300, 100.1}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d p = Vector3d::Zero();
      p(axis) = bad;
      EXPECT_FALSE(inbox.put({p, true})) << bad << ", axis " << axis;
    }
  }
  EXPECT_EQ(inbox.refused(), 18U);
  EXPECT_FALSE(inbox.take());
  EXPECT_TRUE(inbox.put({{nan, 0, 0}, false}));
  ASSERT_TRUE(inbox.take());
  EXPECT_FALSE(inbox.sample().held);
  EXPECT_TRUE(inbox.put({{100, -100, 0}, true}));
  EXPECT_EQ(inbox.refused(), 18U);
}

TEST(PointerDevice, KeepsItsPathInTheReportedWorkspace) {
  PointerDevice device(held_at(0.1), 0.2);
  EXPECT_EQ(device.limits().workspace_min, Vector3d(-0.2, -0.2, 0.1 - 0.2));
  EXPECT_EQ(device.limits().workspace_max, Vector3d(0.2, 0.2, 0.1 + 0.2));
  nanoseconds now{0};
  for (; now < 2s; now += 1ms) {
    device.inbox().put({{99, -99, 99}, true});
    static_cast<void>(device.read(now));
  }
  EXPECT_LE((device.position() - Vector3d(0.2, -0.2, 0.3)).norm(), 1e-5);
}

TEST(PointerDevice, RefusesUnstableGripsAndInvalidReach) {
  SimulatedDeviceConfig config = held_at(0);
  EXPECT_THROW(PointerDevice(config, 0), std::invalid_argument);
  EXPECT_THROW(PointerDevice(config, std::numeric_limits<double>::quiet_NaN()),
               std::invalid_argument);
  config.hand_damping = 0;
  EXPECT_THROW(PointerDevice(config, kReach), std::invalid_argument);
}

TEST(PointerDevice, AcceptsSamplesFromAnotherThread) {
  PointerDevice device(held_at(0), kReach);
  std::thread page([&device] {
    for (int i = 0; i < 20000; ++i) device.inbox().put({Vector3d::Constant(1e-5 * i), i % 7 != 0});
    device.inbox().put({Vector3d::Constant(0.1), true});
  });
  nanoseconds now{0};
  for (int i = 0; i < 2000; ++i) static_cast<void>(device.read(now += 1ms));
  page.join();
  for (int i = 0; i < 1000; ++i) {
    device.inbox().put({Vector3d::Constant(0.1), true});
    static_cast<void>(device.read(now += 1ms));
  }
  EXPECT_LE((device.position() - Vector3d::Constant(0.1)).norm(), 1e-5);
}

// In every third seed, one step in twenty is late, or repeated at one instant.
nanoseconds period_of(unsigned seed, std::mt19937& random) {
  if (seed % 3 != 0 || random() % 20 != 0) return 1ms;
  if (random() % 4 == 0) return 0ms;
  return nanoseconds(1'000'000 + static_cast<int>(random() % 8'800'000));
}

TEST(PointerDevice, MakesNoEnergyAtAWall) {
  double least = 0, peak = 0, fastest = 0, meter = 0;
  std::uint64_t trips = 0, refused = 0;
  const unsigned seeds = test::tries(150U, 1000U);
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    Rig rig;
    PointerPlay play(seed);
    std::mt19937 random(seed);
    for (int ms = 0; ms < 2000; ++ms) {
      play.at(ms, [&](const PointerSample& sample) { rig.device.inbox().put(sample); });
      rig.step(period_of(seed, random));
    }
    ASSERT_GE(rig.least, kPassive) << "seed " << seed;
    ASSERT_LE(rig.peak, rig.device.limits().max_force + 1e-9) << "seed " << seed;
    ASSERT_TRUE(rig.finite) << "seed " << seed;

    // It still works: it follows, and feels the wall.
    rig.hold({0.02, 0, 0.05}, 1500ms);
    ASSERT_LE((rig.device.position() - Vector3d(0.02, 0, 0.05)).norm(), 1e-4) << "seed " << seed;
    rig.hold({0.02, 0, -0.01}, 800ms);
    ASSERT_NEAR(rig.snapshot().force.z(), 2.1, 0.02) << "seed " << seed;
    ASSERT_GE(rig.least, kPassive) << "seed " << seed;
    least = std::min(least, rig.least);
    peak = std::max(peak, rig.peak);
    fastest = std::max(fastest, rig.fastest);
    meter = std::max(meter, rig.meter_above);
    trips += rig.snapshot().trips;
    refused += rig.device.inbox().refused();
  }
  std::printf(
      "least %.2g J, most %.2f N, %.2f m/s, meter above the books by %.2g J, %llu trips, "
      "%llu samples refused\n",
      least, peak, fastest, meter, static_cast<unsigned long long>(trips),
      static_cast<unsigned long long>(refused));
  EXPECT_LE(meter, 1e-9);
  EXPECT_LT(fastest, 2.0) << "no pointer is a fault of the device";
  EXPECT_EQ(trips, 0U);
  EXPECT_GT(refused, seeds);
}

// Follows its course until a pointer takes it, and again after a time without samples.
TEST(PointerDevice, FollowsItsCourseWithoutAPointer) {
  const auto course = [](double time) {
    HandTarget target;
    target.position = Vector3d(0.05 * std::sin(time), 0.0, 0.1);
    return target;
  };
  PointerDevice device(held_at(0.1), kReach, course);
  nanoseconds now{0};
  const auto pass = [&](nanoseconds duration, bool points) {
    for (const nanoseconds end = now + duration; now < end;) {
      now += 1ms;
      if (points && now % kFrame < 1ms) device.inbox().put({{-0.2, 0.0, 0.1}, true});
      static_cast<void>(device.read(now));
      device.write(Vector3d::Zero(), now);
    }
  };
  const auto course_x = [&] { return 0.05 * std::sin(pdu::to_seconds(now)); };
  pass(5s, false);
  EXPECT_NEAR(device.position().x(), course_x(), 0.005) << "behind by the path's lag";
  pass(3s, true);
  EXPECT_NEAR(device.position().x(), -0.2, 0.001);
  pass(15s, false);
  EXPECT_EQ(device.grip(), 0.0) << "let go, and not yet taken again";
  pass(10s, false);
  EXPECT_NEAR(device.position().x(), course_x(), 0.005);
}

}  // namespace
}  // namespace reckon::haptics::pointer_device_test
