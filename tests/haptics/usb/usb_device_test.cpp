// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo's view of a device that reports at its own times.
#include "reckon/haptics/usb/usb_device.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics::usb_device_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

DeviceLimits damped() { return test::damped_limits(falcon_facts()); }

TEST(UsbDevice, ReadsAndWritesAllocateNothing) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  const test::AllocationGuard guard;
  for (int i = 1; i <= 1000; ++i) {
    exchange.readings.push({Vector3d::Zero(), {}, i - 8, i - 7, 1, 0});
    static_cast<void>(device.read(milliseconds(i)));
    device.write(Vector3d::UnitX(), milliseconds(i));
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST(UsbDevice, NonFiniteForceIsZero) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  device.write(Vector3d(std::nan(""), 0, 0), milliseconds(1));
  exchange.force.update();
  EXPECT_TRUE(exchange.force.read().force.isZero(0));
}

// Each motion of the handle is shown in the step for which the ledger books the held force.
TEST(UsbDevice, ReadingIsShownWhenItsForceIsDue) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  const int delay = device.limits().delay_samples;
  // The force of write 10 is held until position 0.1, and the force of write 12 (11 was skipped)
  // from then on until 0.2.
  exchange.readings.push({Vector3d::Zero(), {}, 0, 10, 1, 0});
  exchange.readings.push({Vector3d(0.1, 0, 0), {}, 10, 12, 1, 0});
  exchange.readings.push({Vector3d(0.2, 0, 0), {}, 12, 40, 1, 0});
  for (int write = 1; write <= 12 + delay + 1; ++write) {
    const DeviceSample sample = device.read(milliseconds(write));
    device.write(Vector3d::Zero(), milliseconds(write));
    ASSERT_TRUE(sample.ok);
    const int due = write - 1 - delay;  // the write whose sample ends here
    EXPECT_EQ(sample.position.x(), due < 10 ? 0.0 : due < 12 ? 0.1 : 0.2) << due;
    EXPECT_FALSE(sample.watchdog);
  }
}

TEST(UsbDevice, LateReadingFails) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  exchange.readings.push({Vector3d::Zero(), {}, 0, 1, 1, 0});
  const int delay = device.limits().delay_samples;
  for (int write = 1; write <= 20; ++write) {
    EXPECT_EQ(device.read(milliseconds(write)).ok, write - 1 - delay < 1) << write;
    device.write(Vector3d::Zero(), milliseconds(write));
  }
}

// Otherwise the first force after a silence would use a position from before it.
TEST(UsbDevice, ReadingFromBeforeASilenceIsDropped) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 1, 0});
  EXPECT_TRUE(device.read(milliseconds(1)).ok);
  device.write(Vector3d::UnitX(), milliseconds(1));
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 1, 0});
  EXPECT_TRUE(device.read(milliseconds(11)).ok) << "its watchdog has not acted";
  device.write(Vector3d::UnitX(), milliseconds(11));
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 1, 0});
  EXPECT_FALSE(device.read(milliseconds(22)).ok);
  device.write(Vector3d::Zero(), milliseconds(22));
  EXPECT_FALSE(device.read(milliseconds(23)).ok) << "none has come since";
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 2, 0});
  const DeviceSample sample = device.read(milliseconds(24));
  EXPECT_TRUE(sample.ok && sample.watchdog);
}

// For any length of the declared chain.
TEST(UsbDevice, NothingIsReadAfterARunEnded) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 3, 0});
  EXPECT_TRUE(device.read(milliseconds(1)).ok);
  device.write(Vector3d::UnitX(), milliseconds(1));
  exchange.ended_run = 3;
  EXPECT_FALSE(device.read(milliseconds(2)).ok);
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 4, 0});
  const DeviceSample sample = device.read(milliseconds(3));
  EXPECT_TRUE(sample.ok && sample.watchdog);
}

// Also across failed readings, but not across a dropped force. Reports that are not due yet give
// the present position of the handle.
TEST(UsbDevice, GivesTheDampingOfTheWorstPose) {
  UsbSettings settings;
  settings.joint_damping = 0.02;
  const UsbFacts& facts = falcon_facts();
  UsbExchange exchange;
  UsbDevice device(exchange, usb_limits(facts, settings));
  const DeviceLimits limits = device.limits();
  EXPECT_NEAR(limits.damping, facts.sure_share * 0.02 / (facts.lever * facts.lever), 1e-12);
  const auto push = [&](std::int64_t before, double lever) {
    UsbReading reading;
    reading.before = before;
    reading.after = before + 1;
    reading.run = 1;
    reading.lever = lever;
    reading.step = 1e-3 * lever;
    exchange.readings.push(reading);
  };
  push(0, 2 * facts.lever);
  push(1, 3 * facts.lever);
  DeviceSample sample = device.read(milliseconds(1));
  ASSERT_TRUE(sample.ok && sample.damping && sample.resolution);
  const double margin = std::sqrt(limits.damping / *sample.damping) / 3;
  EXPECT_GT(margin, 1.0) << "it goes on meanwhile";
  EXPECT_LT(margin, 1.2);
  EXPECT_EQ(*sample.resolution, 2e-3 * facts.lever) << "of the place that is shown";
  device.write(Vector3d::UnitX(), milliseconds(1));
  exchange.force.update();
  EXPECT_NEAR(exchange.force.read().lever, 3 * margin * facts.lever, 1e-12);

  push(2, 0.1 * facts.lever);
  for (int i = 2; i < 20; ++i) {
    sample = device.read(milliseconds(i));
    device.write(Vector3d::UnitX(), milliseconds(i));
    if (!sample.ok) continue;
    EXPECT_LE(*sample.damping, limits.damping) << "no more than is stated";
  }
}

TEST(UsbDevice, DampingOfTheHandleHasNoPose) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  UsbReading reading;
  reading.after = reading.run = 1;
  reading.lever = 0.3;
  exchange.readings.push(reading);
  const DeviceSample sample = device.read(milliseconds(1));
  EXPECT_TRUE(sample.ok && !sample.damping && !sample.resolution);
  device.write(Vector3d::UnitX(), milliseconds(1));
  exchange.force.update();
  EXPECT_TRUE(std::isinf(exchange.force.read().lever));
}

TEST(UsbDevice, GivesTheLeastHeldShareOfItsForce) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  UsbReading reading;
  reading.after = reading.run = 1;
  for (const double held : {0.25, 1.0}) {
    reading.held = held;
    exchange.readings.push(reading);
  }
  EXPECT_EQ(device.read(milliseconds(1)).held, 0.25);
  exchange.readings.push(reading);
  EXPECT_EQ(device.read(milliseconds(1)).held, 1.0) << "told once";
}

TEST(UsbDevice, TimesAMotionByTheDevicesClock) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  const int delay = device.limits().delay_samples;
  const auto push = [&](std::int64_t before, std::int64_t after, std::uint32_t run,
                        nanoseconds at) {
    exchange.readings.push({Vector3d::Zero(), {}, before, after, run, 0, at});
  };
  push(0, 1, 1, milliseconds(100));
  push(1, 2, 1, milliseconds(103));
  push(4, 5, 1, milliseconds(107));  // 2 to 4 are not reported
  push(5, 9, 1, milliseconds(108));
  std::vector<std::optional<nanoseconds>> took;
  for (int write = 1; write <= delay + 8; ++write) {
    if (write == delay + 8) push(0, 99, 2, milliseconds(200));
    const DeviceSample sample = device.read(milliseconds(write));
    device.write(Vector3d::Zero(), milliseconds(write));
    if (write > delay && sample.ok) took.push_back(sample.took);
  }
  using ::testing::ElementsAre;
  using ::testing::Optional;
  EXPECT_THAT(took, ElementsAre(Optional(nanoseconds(0)), Optional(milliseconds(3)),
                                Optional(milliseconds(4)), Optional(milliseconds(1)),
                                Optional(nanoseconds(0)), std::nullopt));
}

// The servo is late once; that motion reaches it `delay` steps later, when it is on time again.
TEST(UsbDevice, WithoutAClockWritesTimeAMotion) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  const int delay = device.limits().delay_samples;
  nanoseconds now(0);
  for (int write = 1; write <= 3 * delay; ++write) {
    now += milliseconds(write == delay + 1 ? 4 : 1);
    exchange.readings.push({Vector3d::Zero(), {}, write - 1 - delay, write - delay, 1, 0});
    const DeviceSample sample = device.read(now);
    device.write(Vector3d::Zero(), now);
    if (write <= delay + 1) continue;
    ASSERT_TRUE(sample.ok) << write;
    const int due = write - 1 - delay;
    EXPECT_EQ(sample.took, milliseconds(due == delay ? 4 : 1)) << write;
  }
}

// A motion of 3 mm without readings: over one period it would be 16 mJ of damping.
TEST(UsbDevice, MotionBetweenTwoRunsCountsNoDamping) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  ServoLoop servo(device, EffectPlan(Scene()), ServoConfig());
  nanoseconds now(0);
  const auto rest_at = [&](double x, std::uint32_t run) {
    for (int i = 0; i < 20; ++i) {
      now += milliseconds(1);
      exchange.readings.push({Vector3d(x, 0, 0), {}, 0, 1000, run, 0});
      servo.step(now);
    }
    servo.snapshots().update();
    return servo.snapshots().read();
  };
  EXPECT_EQ(rest_at(0, 1).port_energy, 0);
  const ServoSnapshot after = rest_at(0.003, 2);
  EXPECT_EQ(after.tally.force_drops, 1U);
  EXPECT_NEAR(after.device.x(), 0.003, 1e-12);
  EXPECT_LE(after.port_energy, 1e-12);
}

// A slowly pressing hand, whose way out is unknown.
TEST(UsbDevice, DroppedForceCostsTheMeterTheStoredEnergy) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  ServoLoop servo(device, EffectPlan(test::stiff_floor()), ServoConfig());
  const int delay = device.limits().delay_samples;
  int write = 0;
  const auto read_at = [&](double z, std::uint32_t run) {
    const std::int64_t held = std::max(0, write++ - delay);
    exchange.readings.push({Vector3d(0, 0, z), {}, held, held + 1, run, 0});
    servo.step(milliseconds(write));
    servo.snapshots().update();
    return servo.snapshots().read();
  };
  for (int i = 0; i < 400; ++i) read_at(0.001 - 1e-5 * i, 1);
  const ServoSnapshot pressed = read_at(-0.003, 1);
  const double stored = 0.5 * pressed.force.z() * 0.003;
  ASSERT_GT(stored, 1e-4) << "no wall is felt";
  EXPECT_LE(read_at(0.001, 2).port_energy, pressed.port_energy - stored + 1e-12);
}

TEST(UsbDevice, ReportsADroppedForce) {
  UsbExchange exchange;
  UsbDevice device(exchange, damped());
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 1, 0});
  EXPECT_TRUE(device.read(milliseconds(1)).ok);
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 2, 0});
  const DeviceSample sample = device.read(milliseconds(2));
  EXPECT_TRUE(sample.ok && sample.watchdog);
  EXPECT_FALSE(sample.released_at) << "nobody knows where";
  EXPECT_FALSE(device.read(milliseconds(3)).watchdog);
}

}  // namespace
}  // namespace reckon::haptics::usb_device_test
