// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[device]] of a scene file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>
#include <string>
#include <utility>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer::device_section_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test::refusal;
using testing::HasSubstr;

constexpr const char* kOperator = "[[operator]]\npassive = true\n";

DeviceConfig device_of(const std::string& lines) {
  return parse_scene_file("[[device]]\n" + lines + kOperator, "x.toml").devices.at(0);
}

TEST(DeviceSection, GivesEveryValueInSi) {
  const DeviceConfig device = device_of(R"(
peer = 64
operator = 1
marking = "LEFT"
position = "-20 0 5 cm"
max_force = "12 N"
damping = "2 N s/m"
max_stiffness = "3 kN/m"
max_speed = "500 mm/s"
max_force_rate = "0.2 kN/s"
received_power = "400 mW"
region_loan = "50 mJ"
oscillation_power = "30 mW"
oscillation_energy = "5 mJ"
resolution = "20 um"
rate = "4 kHz"
delay = "1 ms"
)");
  EXPECT_EQ(device.peer, 64u);
  EXPECT_EQ(device.operator_number, 1u);
  EXPECT_EQ(device.marking, "LEFT");
  EXPECT_EQ(device.position, Vector3d(-0.2, 0, 0.05));
  EXPECT_EQ(device.max_force, 12);
  EXPECT_EQ(device.damping, 2);
  EXPECT_EQ(device.max_stiffness, 3000);
  EXPECT_EQ(device.max_speed, 0.5);
  EXPECT_EQ(device.max_force_rate, 200);
  EXPECT_EQ(device.received_power, 0.4);
  EXPECT_EQ(device.regions.loan, 0.05);
  EXPECT_EQ(device.regions.oscillation_power, 0.03);
  EXPECT_EQ(device.regions.oscillation_energy, 0.005);
  EXPECT_NEAR(device.resolution, 2e-5, 1e-18);
  EXPECT_EQ(device.period, microseconds(250));
  EXPECT_EQ(device.delay_samples, 4);
}

TEST(DeviceSection, NamesAPointerAndHowFarItReaches) {
  EXPECT_EQ(device_of("kind = \"simulated\"\n").source, DeviceSource::simulated);
  const DeviceConfig device = device_of("kind = \"pointer\"\nreach = \"30 cm\"\n");
  EXPECT_EQ(device.source, DeviceSource::pointer);
  EXPECT_EQ(device.reach, 0.3);
}

TEST(DeviceSection, RefusesPointersWithMovingOrUndampedOperators) {
  const std::string pointer = "[[device]]\nkind = \"pointer\"\n";
  EXPECT_THAT(refusal(pointer + "[[operator]]\nsweep = { from = [0, 0, 0], to = [1, 0, 0] }\n"),
              HasSubstr("x.toml:2:8: the pointer and [[operator]] 1 both move the hand: write "
                        "passive = true and a start position there"));
  EXPECT_THAT(refusal(pointer + kOperator + "damping = 0\n"),
              HasSubstr("x.toml:2:8: the grip of a pointer needs damping"));
}

TEST(DeviceSection, SixAxisDeviceTurnsAToolOfProbes) {
  const DeviceConfig device = device_of(R"(
axes = 6
turn_damping = "0.02 Nm s/rad"
max_torque = "500 mN m"
turn_resolution = "0.1 deg"
[[device.probe]]
position = "40 0 0 mm"
[[device.probe]]
position = "-60 0 0 mm"
)");
  EXPECT_EQ(device.axes, 6);
  EXPECT_NEAR(device.turn_damping, 0.02, 1e-15);
  EXPECT_EQ(device.max_torque, 0.5);
  EXPECT_NEAR(device.turn_resolution, 0.1 * std::numbers::pi / 180, 1e-15);
  ASSERT_EQ(device.probes.size(), 2u);
  EXPECT_EQ(device.probes[1].position, Vector3d(-0.06, 0, 0));
  EXPECT_EQ(device_of("").axes, 3);
  EXPECT_TRUE(device_of("axes = 6\n").probes.empty()) << "the handle touches";
}

TEST(DeviceSection, RefusesAToolThatItsDeviceCannotTurn) {
  const auto refused = [](const std::string& lines) {
    return refusal("[[device]]\n" + lines + kOperator);
  };
  EXPECT_THAT(refused("[[device.probe]]\nposition = \"40 0 0 mm\"\n"),
              HasSubstr("'probe' needs axes = 6: add it"));
  EXPECT_THAT(refused("max_torque = \"1 N m\"\n"), HasSubstr("'max_torque' needs axes = 6"));
  EXPECT_THAT(refused("axes = 4\n"),
              HasSubstr("x.toml:2:8: a device has 3 axes, or 6 with torque"));
  EXPECT_THAT(refused("axes = 6\ndamping = 0\n"), HasSubstr("needs damping: set it above 0"));
  EXPECT_THAT(refused("axes = 6\nkind = \"pointer\"\n"), HasSubstr("a pointer moves three axes"));
  EXPECT_THAT(refused("axes = 6\ndriver = \"falcon\"\n"), HasSubstr("a Falcon has three axes"));
  std::string nine = "axes = 6\n";
  for (int i = 0; i < 9; ++i) nine += "[[device.probe]]\n";
  EXPECT_THAT(refused(nine), HasSubstr("a tool has at most 8 probes, and this one has 9"));
}

TEST(DeviceSection, MakesADeviceThatMovesByItself) {
  const AdmittanceConfig plain =
      device_of(
          "virtual_mass = \"3 kg\"\nbandwidth = \"50 Hz\"\nsensor_stiffness = \"10 kN/m\"\n"
          "motion_loop = \"velocity\"\ndelay = \"2 ms\"\n")
          .admittance;
  EXPECT_EQ(plain.mass, 3);
  EXPECT_EQ(plain.bandwidth, 50);
  EXPECT_EQ(plain.sensor_stiffness, 10e3);
  EXPECT_EQ(plain.loop, haptics::MotionLoop::velocity);
  EXPECT_EQ(device_of("").admittance.mass, 0) << "it takes forces";
  const auto refused = [](const std::string& lines) {
    return refusal("[[device]]\n" + lines + kOperator);
  };
  const std::string mass = "virtual_mass = \"2 kg\"\n";
  EXPECT_THAT(refused("bandwidth = \"30 Hz\"\n"), HasSubstr("add virtual_mass"));
  EXPECT_THAT(refused(mass + "axes = 6\n"), HasSubstr("a virtual mass has no rotation"));
  EXPECT_THAT(refused(mass + "kind = \"pointer\"\n"),
              HasSubstr("a pointer needs an impedance device"));
  EXPECT_THAT(refused(mass + "driver = \"falcon\"\n"), HasSubstr("only a simulated device"));
  EXPECT_THAT(refused(mass + "damping = 0\n"), HasSubstr("a virtual mass needs damping"));
  EXPECT_THAT(refused(mass + "resolution = \"10 um\"\n"),
              HasSubstr("is exact: remove 'resolution'"));
}

// At any accepted rate: one period is missed and the next step is half a period late.
TEST(DeviceSection, DeviceHoldsItsForceOverAMissedPeriod) {
  for (int rate = 50; rate <= 1000; rate += 50) {
    const std::string text = "rate = \"" + std::to_string(rate) + " Hz\"\n";
    if (!refusal("[[device]]\n" + text + kOperator).empty()) continue;
    const nanoseconds period = device_of(text).period;
    haptics::SimulatedDevice device({}, {});
    (void)device.read(nanoseconds(0));
    device.write({1, 0, 0}, nanoseconds(0));
    EXPECT_FALSE(device.read(2 * period + period / 2).watchdog) << rate << " Hz";
  }
}

TEST(DeviceSection, HasTheDefaultsOfItsStruct) {
  const DeviceConfig silent = device_of(""), standard;
  EXPECT_EQ(silent.peer, standard.peer);
  EXPECT_EQ(silent.operator_number, standard.operator_number);
  EXPECT_EQ(silent.max_force, standard.max_force);
  EXPECT_EQ(silent.damping, standard.damping);
  EXPECT_EQ(silent.joint_damping, standard.joint_damping);
  EXPECT_EQ(silent.max_stiffness, standard.max_stiffness);
  EXPECT_EQ(silent.max_speed, standard.max_speed);
  EXPECT_EQ(silent.max_force_rate, standard.max_force_rate);
  EXPECT_EQ(silent.received_power, standard.received_power);
  EXPECT_EQ(silent.regions.loan, standard.regions.loan);
  EXPECT_EQ(silent.regions.oscillation_power, standard.regions.oscillation_power);
  EXPECT_EQ(silent.regions.oscillation_energy, standard.regions.oscillation_energy);
  EXPECT_EQ(silent.resolution, standard.resolution);
  EXPECT_EQ(silent.axes, standard.axes);
  EXPECT_EQ(silent.turn_damping, standard.turn_damping);
  EXPECT_EQ(silent.max_torque, standard.max_torque);
  EXPECT_EQ(silent.turn_resolution, standard.turn_resolution);
  EXPECT_EQ(silent.period, standard.period);
  EXPECT_EQ(silent.delay_samples, standard.delay_samples);
  EXPECT_EQ(silent.source, standard.source);
  EXPECT_EQ(silent.driver, standard.driver);
  EXPECT_TRUE(silent.driver_values.empty());
  EXPECT_EQ(silent.reach, standard.reach);
  EXPECT_EQ(silent.orientation.coeffs(), standard.orientation.coeffs());
}

TEST(DeviceSection, CountsDelayInWholePeriodsRoundedUp) {
  const auto samples = [](const std::string& delay, const std::string& rate) {
    return device_of("delay = \"" + delay + "\"\nrate = \"" + rate + "\"\n").delay_samples;
  };
  EXPECT_EQ(samples("0 ms", "1 kHz"), 0);
  EXPECT_EQ(samples("1 us", "1 kHz"), 1);
  EXPECT_EQ(samples("1 ms", "1 kHz"), 1);
  EXPECT_EQ(samples("1.01 ms", "1 kHz"), 2);
  EXPECT_EQ(samples("1 ms", "3 kHz"), 3) << "a period of 333.333 us is not cut short";
  EXPECT_EQ(samples("5 ms", "250 Hz"), 2);
  EXPECT_EQ(samples("100 ms", "10 kHz"), 1000);
}

TEST(DeviceSection, TurnsItsAxesRelativeToTheScene) {
  struct Case {
    const char* keys;
    Vector3d right, forward;
  };
  for (const auto& [keys, right, forward] :
       {Case{"", {1, 0, 0}, {0, 1, 0}}, Case{"heading = \"90 deg\"\n", {0, -1, 0}, {1, 0, 0}},
        Case{"pitch = \"90 deg\"\n", {1, 0, 0}, {0, 0, 1}},
        Case{"roll = \"90 deg\"\n", {0, 0, -1}, {0, 1, 0}},
        Case{"orientation = \"0 0 90 deg\"\n", {0, 1, 0}, {-1, 0, 0}},
        Case{"heading = \"90 deg\"\npitch = \"90 deg\"\n", {0, -1, 0}, {0, 0, 1}}}) {
    const DeviceConfig device = device_of(keys);
    EXPECT_LE((device.orientation * Vector3d::UnitX() - right).norm(), 1e-15) << keys;
    EXPECT_LE((device.orientation * Vector3d::UnitY() - forward).norm(), 1e-15) << keys;
    EXPECT_NEAR(device.orientation.norm(), 1, 1e-15);
  }
}

TEST(DeviceSection, RefusesInconsistentKeys) {
  const std::pair<std::string, const char*> cases[] = {
      {"operator = 2\n",
       "x.toml:2:12: there is no [[operator]] 2: the file has 1; name one of them or add one"},
      {"rate = \"249 Hz\"\n", "x.toml:2:8: 'rate' is 249 Hz; it must be 250 Hz to 10 kHz"},
      {"rate = \"10.1 kHz\"\n", "it must be 250 Hz to 10 kHz"},
      {"delay = \"101 ms\"\n", "x.toml:2:9: 'delay' is 101 ms; it must be 0 s to 100 ms"},
      {"delay = \"-1 ms\"\n", "it must be"},
      {"rate = nan\n", "it must be"},
      {"max_force = 0\n", "it must be"},
      {"marking = \"TWELVE CHARS\"\n", "use at most 11"},
      {"heading = 0\norientation = [0, 0, 0]\n",
       "x.toml:3:15: 'orientation' and heading, pitch or roll"},
      {"peer = 65\n", "it must be 1 to 64"},
      {"kind = \"mouse\"\n", "it needs one of simulated pointer"},
      {"kind = \"pointer\"\nreach = 0\n", "x.toml:3:9: 'reach' is 0 m; it must be 1 mm to 10 m"},
      {"reach = 0.1\n", "x.toml:2:9: 'reach' needs kind = \"pointer\": add it"},
  };
  for (const auto& [lines, words] : cases) {
    EXPECT_THAT(refusal("[[device]]\n" + lines + kOperator), HasSubstr(words)) << lines;
  }
  EXPECT_THAT(refusal("[[device]]\n"),
              HasSubstr("x.toml:1:1: there is no [[operator]] 1: the file has 0;"));
}

}  // namespace
}  // namespace reckon::peer::device_section_test
