// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Loaded drivers: the example against a simulated device with the same numbers, and the treatment
// of faulty drivers.
#include "reckon/haptics/plugin/plugin_device.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics::plugin_device_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

const std::filesystem::path kDrivers = RECKON_TEST_DRIVERS;
std::filesystem::path driver(const std::string& name) { return kDrivers / (name + ".so"); }

/// The message for a refused driver; empty: it is accepted.
std::string refusal(const std::filesystem::path& file, const std::string& options = "") {
  try {
    const PluginDevice device(file, options);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

Scene wall() {
  Scene scene;
  SceneObject& floor = scene.objects.emplace_back();
  floor.name = "floor";
  floor.shape = PlaneShape{Vector3d::UnitZ()};
  floor.effects.of<SpringDamper>() = {500.0, 0.0};
  return scene;
}

// The same plant in an independent implementation: the force at the wall is the same.
TEST(PluginDevice, ExampleFeelsLikeItsSimulatedDevice) {
  const auto plan = std::make_shared<const EffectPlan>(wall());
  PluginDevice loaded(driver("dummy_device"), "0 0 -0.01");
  SimulatedDeviceConfig config;
  config.hand_stiffness = 200;
  config.start = {0, 0, -0.01};
  SimulatedDevice simulated(config);
  EXPECT_EQ(loaded.name(), "dummy");
  EXPECT_EQ(loaded.limits().damping, simulated.limits().damping);
  ServoLoop one(loaded, plan, ServoConfig{}), other(simulated, plan, ServoConfig{});
  double most = 0.0;
  for (int i = 0; i < 3'000; ++i) {
    const nanoseconds now(1'000'000'000 + 1'000'000L * i);
    one.step(now);
    other.step(now);
    ASSERT_TRUE(one.snapshots().update() && other.snapshots().update());
    const ServoSnapshot &a = one.snapshots().read(), &b = other.snapshots().read();
    EXPECT_NEAR(a.force.z(), b.force.z(), 1e-6) << i;
    EXPECT_GE(a.port_energy_min, -1e-9);
    most = std::max(most, a.force.z());
  }
  // Two springs in series: 200 and 500 N/m over 10 mm.
  EXPECT_NEAR(most, 0.01 * 200 * 500 / 700, 0.02);
  EXPECT_TRUE(loaded.take_notices().empty());
}

TEST(PluginDevice, ExampleReleasesWithoutWrites) {
  PluginDevice device(driver("dummy_device"), "");
  static_cast<void>(device.read(nanoseconds(0)));
  device.write({0, 0, 3}, nanoseconds(0));
  EXPECT_FALSE(device.read(std::chrono::milliseconds(9)).watchdog);
  const DeviceSample sample = device.read(std::chrono::milliseconds(40));
  EXPECT_TRUE(sample.watchdog);
  ASSERT_TRUE(sample.released_at);
  EXPECT_GT(sample.released_at->z(), 0.0);
  EXPECT_FALSE(device.read(std::chrono::milliseconds(80)).watchdog);
}

TEST(PluginDevice, IsReadAndWrittenWithoutAllocation) {
  PluginDevice device(driver("dummy_device"), "");
  const test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    static_cast<void>(device.read(nanoseconds(1'000'000L * i)));
    device.write({0, 0, 1}, nanoseconds(1'000'000L * i));
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST(PluginDevice, InvalidDriversAreRefusedWithTheRemedy) {
  const test::ScratchFolder folder;
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(refusal(folder.file("none.so")), "none.so: no such file");
  says(refusal(driver("no_table")), "no function reckon_device_driver_table");
  says(refusal(driver("other_abi")), "was built for version 2 of device_plugin.h");
  says(refusal(driver("half_table")), "lacks a function");
  says(refusal(driver("dummy_device"), "here"), "options are a place");
  says(refusal(driver("faulty_device"), "mute"), "open function fails without a message");
  EXPECT_LT(refusal(driver("faulty_device"), "chatty").size(), 600U);
  EXPECT_TRUE(refusal(driver("faulty_device"), "").empty());
}

// A device that was opened is closed in every case.
TEST(PluginDevice, ImpossibleLimitsCloseAndRefuseTheDevice) {
  void* const library = dlopen(driver("faulty_device").c_str(), RTLD_NOW);
  ASSERT_NE(library, nullptr);
  const auto left_open = reinterpret_cast<int (*)()>(dlsym(library, "left_open"));
  ASSERT_NE(left_open, nullptr);
  for (const auto& [fault, named] : {std::pair<std::string, std::string>{"axes", "axes must be"},
                                     {"delay", "delay_samples"},
                                     {"force", "max_force"},
                                     {"damping", "damping"},
                                     {"speed", "max_speed"},
                                     {"resolution", "resolution"},
                                     {"space", "workspace_min"}}) {
    const std::string said = refusal(driver("faulty_device"), fault);
    EXPECT_NE(said.find("invalid limits: " + named), std::string::npos) << fault << ": " << said;
    EXPECT_EQ(left_open(), 0) << fault;
  }
  dlclose(library);
}

TEST(PluginDevice, InvalidReadingsFailAndAreReportedOnce) {
  for (const char* fault : {"place", "speeds", "turned"}) {
    PluginDevice device(driver("faulty_device"), fault);
    EXPECT_FALSE(device.read(nanoseconds(1)).ok) << fault;
    EXPECT_FALSE(device.read(nanoseconds(2)).ok) << fault;
    EXPECT_EQ(device.take_notices().size(), 1U) << fault;
    EXPECT_FALSE(device.read(nanoseconds(3)).ok);
    EXPECT_TRUE(device.take_notices().empty()) << fault;
  }
  PluginDevice silent(driver("faulty_device"), "silent");
  EXPECT_FALSE(silent.read(nanoseconds(1)).ok);
  EXPECT_TRUE(silent.take_notices().empty()) << "a reading that fails is counted by the servo";
  PluginDevice good(driver("faulty_device"), "");
  EXPECT_TRUE(good.read(nanoseconds(1)).ok);
  EXPECT_EQ(good.read(nanoseconds(2)).buttons, 5U);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  good.write({nan, 0, 0}, nanoseconds(2));
}

TEST(PluginDevice, ReportsADriverThatBlocksTheServo) {
  PluginDevice device(driver("faulty_device"), "slow");
  static_cast<void>(device.read(nanoseconds(1)));
  EXPECT_TRUE(device.take_notices().empty()) << "once may be the host's doing";
  for (int i = 2; i < 20; ++i) static_cast<void>(device.read(nanoseconds(i)));
  const std::vector<std::string> said = device.take_notices();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("delayed the servo"), std::string::npos) << said[0];
}

}  // namespace
}  // namespace reckon::haptics::plugin_device_test
