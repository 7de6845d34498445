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
#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer {
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
  EXPECT_EQ(device.region_loan, 0.05);
  EXPECT_EQ(device.oscillation_power, 0.03);
  EXPECT_EQ(device.oscillation_energy, 0.005);
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

TEST(DeviceSection, RefusesAPointerWhoseOperatorMovesTooOrHasNoDamping) {
  const std::string pointer = "[[device]]\nkind = \"pointer\"\n";
  EXPECT_THAT(
      refusal(pointer + "[[operator]]\nsweep = { from = [0, 0, 0], to = [1, 0, 0] }\n"),
      HasSubstr("x.toml:2:8: a pointer moves the hand, and so would [[operator]] 1: give that "
                "passive = true and the position where the hand starts"));
  EXPECT_THAT(refusal(pointer + kOperator + "damping = 0\n"),
              HasSubstr("x.toml:2:8: a pointer needs a grip with damping"));
}

TEST(DeviceSection, OfSixAxesTurnsAToolOfSomeProbes) {
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
              HasSubstr("only a device that turns has 'probe': add axes = 6"));
  EXPECT_THAT(refused("max_torque = \"1 N m\"\n"),
              HasSubstr("only a device that turns has 'max_torque'"));
  EXPECT_THAT(refused("axes = 4\n"),
              HasSubstr("x.toml:2:8: a device has 3 axes, or 6 with torque"));
  EXPECT_THAT(refused("axes = 6\ndamping = 0\n"), HasSubstr("needs damping in all of them"));
  EXPECT_THAT(refused("axes = 6\nkind = \"pointer\"\n"), HasSubstr("a pointer moves three axes"));
  EXPECT_THAT(refused("axes = 6\ndriver = \"falcon\"\n"), HasSubstr("a Falcon has three axes"));
  std::string nine = "axes = 6\n";
  for (int i = 0; i < 9; ++i) nine += "[[device.probe]]\n";
  EXPECT_THAT(refused(nine), HasSubstr("a tool has at most 8 probes, this one has 9"));
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
  EXPECT_THAT(refused(mass + "axes = 6\n"), HasSubstr("a virtual mass does not turn"));
  EXPECT_THAT(refused(mass + "kind = \"pointer\"\n"), HasSubstr("a pointer holds a device"));
  EXPECT_THAT(refused(mass + "driver = \"falcon\"\n"), HasSubstr("only a simulated device"));
  EXPECT_THAT(refused(mass + "damping = 0\n"), HasSubstr("a virtual mass needs damping"));
  EXPECT_THAT(refused(mass + "resolution = \"10 um\"\n"), HasSubstr("computed and exact"));
}

// What a servo may rely on is the driver's to say, as far as the file does not.
TEST(DeviceSection, NamesAFalconAndTakesItsLimits) {
  EXPECT_EQ(device_of("driver = \"simulated\"\n").driver, DeviceDriver::simulated);
  const DeviceConfig plain = device_of("driver = \"falcon\"\n");
  EXPECT_EQ(plain.driver, DeviceDriver::falcon);
  EXPECT_EQ(plain.max_force, 8.9);
  EXPECT_EQ(plain.delay_samples, 6);
  // Assumed of the middle, less a tenth; elsewhere it is that of the joints.
  EXPECT_NEAR(plain.damping, 0.9 * 0.3, 3e-4);
  EXPECT_NEAR(plain.joint_damping, haptics::falcon_facts().joints_per_damping * 0.3, 1e-12);
  EXPECT_EQ(plain.resolution, 90e-6);

  const DeviceConfig known = device_of(
      "driver = \"falcon\"\ndamping = \"2 N s/m\"\ndelay = \"3.5 ms\"\nmax_force = \"5 N\"\n");
  EXPECT_EQ(known.delay_samples, 4);
  EXPECT_NEAR(known.damping, 1.8, 1e-12);
  EXPECT_EQ(known.max_force, 5);
  // And its device has the same.
  const haptics::DeviceLimits limits =
      haptics::usb_limits(haptics::falcon_facts(), usb_settings_of(known));
  EXPECT_EQ(limits.delay_samples, 4);
  EXPECT_NEAR(limits.damping, 1.8, 1e-12);
}

TEST(DeviceSection, RefusesWhatAFalconIsNot) {
  const std::string falcon = "[[device]]\ndriver = \"falcon\"\n";
  EXPECT_THAT(refusal("[[device]]\ndriver = \"falkon\"\n" + std::string(kOperator)),
              HasSubstr("did you mean \"falcon\"?"));
  EXPECT_THAT(refusal(falcon + "kind = \"pointer\"\n" + kOperator),
              HasSubstr("no pointer moves it"));
  EXPECT_THAT(refusal(falcon + "resolution = \"10 um\"\n" + kOperator),
              HasSubstr("knows the steps"));
  EXPECT_THAT(refusal(falcon + "rate = \"300 Hz\"\n" + kOperator), HasSubstr("400 Hz is enough"));
  EXPECT_THAT(refusal(falcon + "firmware = \"no_such_file\"\n" + kOperator),
              HasSubstr("no_such_file"));
  EXPECT_THAT(refusal("[[device]]\nfirmware = \"no_such_file\"\n" + std::string(kOperator)),
              HasSubstr("only a Falcon has one"));
}

TEST(DeviceSection, APluginIsNamedByItsFile) {
  const std::string plugin = "[[device]]\ndriver = \"plugin\"\n";
  EXPECT_THAT(refusal(plugin + kOperator), HasSubstr("name it with plugin = \"driver.so\""));
  EXPECT_THAT(refusal(plugin + "plugin = \"drivers/\"\n" + kOperator),
              HasSubstr("name it with plugin = \"driver.so\""));
  EXPECT_EQ(refusal(plugin + "plugin = \"no_such.so\"\n" + kOperator), "") << "it is not opened";
  EXPECT_THAT(refusal("[[device]]\nplugin_options = \"x\"\n" + std::string(kOperator)),
              HasSubstr("add driver = \"plugin\""));
}

constexpr const char* kWheel =
    "driver = \"evdev\"\ntravel = \"0.2 m\"\nfull_force = \"20 N\"\nfull_stiffness = \"2 kN/m\"\n"
    "max_stiffness = \"1.5 kN/m\"\n";

TEST(DeviceSection, AnEventDeviceIsWhatItsKeysSay) {
  const DeviceConfig plain = device_of(kWheel);
  EXPECT_EQ(plain.driver, DeviceDriver::evdev);
  haptics::EvdevSettings settings = evdev_settings_of(plain);
  EXPECT_EQ(settings.axes, 2);
  EXPECT_EQ(settings.scale.travel, 0.2);
  EXPECT_EQ(settings.scale.full_force, 20);
  EXPECT_EQ(settings.scale.full_stiffness, 2000);
  EXPECT_EQ(settings.max_stiffness, 1500);
  EXPECT_EQ(settings.chain, haptics::EvdevSettings::kChain);

  const DeviceConfig known =
      device_of(std::string(kWheel) +
                "event = \"FFBoard\"\nevent_axes = 1\ndelay = \"3 ms\"\nmax_force = \"5 N\"\n");
  settings = evdev_settings_of(known);
  EXPECT_EQ(settings.event, "FFBoard");
  EXPECT_EQ(settings.axes, 1);
  EXPECT_EQ(settings.chain, std::chrono::milliseconds(3));
  EXPECT_EQ(haptics::evdev_limits(settings).max_force, 5);
}

TEST(DeviceSection, RefusesAnEventDeviceOfWhichSomethingIsNotSaid) {
  const std::string whole = kWheel;
  for (const std::string key : {"travel", "full_force", "full_stiffness", "max_stiffness"}) {
    const std::size_t from = whole.find(key);
    const std::string less = std::string(whole).erase(from, whole.find('\n', from) + 1 - from);
    EXPECT_THAT(refusal("[[device]]\n" + less + kOperator), HasSubstr("state '" + key + "'"));
  }
  EXPECT_THAT(refusal("[[device]]\n" + whole + "scale = 2\n" + kOperator),
              HasSubstr("take 'scale'"));
  EXPECT_THAT(refusal("[[device]]\n" + whole + "axes = 6\n" + kOperator),
              HasSubstr("take 'axes' out"));
  EXPECT_THAT(refusal("[[device]]\n" + whole + "kind = \"pointer\"\n" + kOperator),
              HasSubstr("no pointer moves it"));
  EXPECT_THAT(
      refusal("[[device]]\ndriver = \"falcon\"\ntravel = \"0.2 m\"\n" + std::string(kOperator)),
      HasSubstr("say driver = \"evdev\""));
}

TEST(DeviceSection, NamesAPolhemAndTakesItsLimits) {
  const DeviceConfig plain = device_of("driver = \"polhem\"\n");
  EXPECT_EQ(plain.driver, DeviceDriver::polhem);
  EXPECT_EQ(plain.max_force, 5.0);
  EXPECT_EQ(plain.delay_samples, 6);
  const double lever = haptics::polhem_facts().lever;
  EXPECT_NEAR(plain.damping,
              0.9 * haptics::polhem_facts().joints_per_damping * 0.2 / (lever * lever), 1e-12)
      << "assumed";
  EXPECT_EQ(plain.resolution, 95e-6);

  // To hold the links up costs damping: the slope of the torque, an exchange late, at 50 mm.
  const DeviceConfig held = device_of(
      "driver = \"polhem\"\ndamping = \"2 N s/m\"\nupper_weight = \"0.17 N m\"\n"
      "fore_weight = \"0.055 N m\"\n");
  EXPECT_NEAR(held.damping, 1.8 - 0.17 * 0.002 / (0.05 * 0.05), 1e-12);
  EXPECT_EQ(polhem_weights_of(held).upper, 0.17);
  EXPECT_EQ(polhem_weights_of(held).fore, 0.055);
  // And its device has the same.
  const haptics::DeviceLimits limits =
      haptics::usb_limits(haptics::polhem_facts(), usb_settings_of(held));
  EXPECT_NEAR(limits.damping, held.damping, 1e-12);
}

TEST(DeviceSection, TakesTheFrictionOfJointsInThePlaceOfThatOfTheHandle) {
  for (const auto& [name, facts] :
       {std::pair("falcon", &haptics::falcon_facts()), {"polhem", &haptics::polhem_facts()}}) {
    const DeviceConfig device =
        device_of("driver = \"" + std::string(name) + "\"\njoint_damping = \"0.02 N m s/rad\"\n");
    const double square = facts->lever * facts->lever;
    EXPECT_NEAR(device.damping, 0.9 * 0.02 / square, 1e-9) << name;
    // And its device has the same.
    const haptics::DeviceLimits limits = haptics::usb_limits(*facts, usb_settings_of(device));
    EXPECT_NEAR(limits.damping, device.damping, 1e-12) << name;
    EXPECT_EQ(limits.lever, facts->lever) << name;
  }
  EXPECT_EQ(haptics::usb_limits(haptics::falcon_facts(),
                                usb_settings_of(device_of("driver = \"falcon\"\ndamping = 1\n")))
                .lever,
            0.0)
      << "of the handle where that is said";
  // To hold the links up costs the slope of the torque, an exchange late, wherever they are.
  const DeviceConfig held = device_of(
      "driver = \"polhem\"\njoint_damping = \"0.02 N m s/rad\"\nupper_weight = \"0.17 N m\"\n");
  const double lever = haptics::polhem_facts().lever;
  EXPECT_NEAR(held.damping, (0.9 * 0.02 - 0.17 * 0.002) / (lever * lever), 1e-9);
  const auto refused = [](const std::string& lines) {
    return refusal("[[device]]\n" + lines + kOperator);
  };
  const std::string joints = "joint_damping = \"0.02 N m s/rad\"\n";
  EXPECT_THAT(refused(joints), HasSubstr("only the joints of a Falcon or a Polhem are known"));
  EXPECT_THAT(refused("driver = \"falcon\"\ndamping = \"1 N s/m\"\n" + joints),
              HasSubstr("friction is said twice"));
}

TEST(DeviceSection, RefusesWhatAPolhemIsNot) {
  const std::string polhem = "[[device]]\ndriver = \"polhem\"\n";
  EXPECT_THAT(refusal(polhem + "axes = 6\n" + kOperator), HasSubstr("a Polhem has three axes"));
  EXPECT_THAT(refusal(polhem + "rate = \"300 Hz\"\n" + kOperator), HasSubstr("a Polhem is let go"));
  EXPECT_THAT(refusal(polhem + "kind = \"pointer\"\n" + kOperator),
              HasSubstr("a person holds a Polhem"));
  EXPECT_THAT(refusal(polhem + "firmware = \"x.bin\"\n" + kOperator),
              HasSubstr("only a Falcon has one"));
  EXPECT_THAT(refusal(polhem + "damping = 0.2\nupper_weight = \"0.5 N m\"\n" + kOperator),
              HasSubstr("costs 0.4 N s/m of damping"));
  EXPECT_THAT(refusal(polhem + "joint_damping = 0.001\nupper_weight = \"0.5 N m\"\n" + kOperator),
              HasSubstr("costs 0.001 N m s/rad of joint_damping"));
  for (const std::string key : {"upper_weight", "fore_weight"}) {
    EXPECT_THAT(refusal("[[device]]\n" + key + " = \"0.1 N m\"\n" + kOperator),
                HasSubstr("only a Polhem has links"));
  }
}

TEST(DeviceSection, NamesASerialBoardAndWhatIsKnownOfIt) {
  const DeviceConfig plain = device_of("driver = \"serial\"\nport = \"/dev/ttyACM0\"\n");
  EXPECT_EQ(plain.driver, DeviceDriver::serial);
  EXPECT_EQ(plain.port, "/dev/ttyACM0");
  EXPECT_EQ(plain.baud, 1'000'000U);
  EXPECT_EQ(plain.max_force, 1.0) << "assumed";
  EXPECT_NEAR(plain.damping, 0.9 * 0.1, 1e-12) << "assumed, less a tenth";
  EXPECT_EQ(plain.resolution, 100e-6) << "assumed";
  EXPECT_EQ(plain.delay_samples, 6);

  const DeviceConfig known = device_of(
      "driver = \"serial\"\nport = \"/dev/ttyUSB0\"\nbaud = 115200\nmax_force = \"3 N\"\n"
      "resolution = \"14.7 um\"\ndamping = \"2 N s/m\"\ndelay = \"3.5 ms\"\n");
  EXPECT_EQ(known.baud, 115'200U);
  EXPECT_EQ(known.max_force, 3.0);
  EXPECT_NEAR(known.resolution, 14.7e-6, 1e-18);
  EXPECT_NEAR(known.damping, 1.8, 1e-12);
  EXPECT_EQ(known.delay_samples, 4);
  // And its device has the same.
  const haptics::DeviceLimits limits =
      haptics::usb_limits(haptics::serial_facts(), usb_settings_of(known));
  EXPECT_EQ(limits.max_force, known.max_force);
  EXPECT_EQ(limits.resolution, known.resolution);
  EXPECT_NEAR(limits.damping, 1.8, 1e-12);
  EXPECT_EQ(limits.delay_samples, 4);
}

TEST(DeviceSection, RefusesWhatASerialBoardIsNot) {
  const std::string serial = "[[device]]\ndriver = \"serial\"\n";
  EXPECT_THAT(refusal(serial + kOperator), HasSubstr("name that with port = \"/dev/ttyACM0\""));
  const std::string wired = serial + "port = \"/dev/ttyACM0\"\n";
  EXPECT_THAT(refusal(wired + "axes = 6\n" + kOperator), HasSubstr("take out axes = 6"));
  EXPECT_THAT(refusal(wired + "rate = \"300 Hz\"\n" + kOperator), HasSubstr("after 6.5 ms"));
  EXPECT_THAT(refusal(wired + "kind = \"pointer\"\n" + kOperator),
              HasSubstr("a person holds a serial board"));
  for (const std::string key : {"port = \"/dev/ttyACM0\"", "baud = 9600"}) {
    EXPECT_THAT(refusal("[[device]]\n" + key + "\n" + kOperator),
                HasSubstr("only a board on a serial line has it"));
  }
}

// Whose device it is, is each host's own matter.
TEST(DeviceSection, ADriverDoesNotChangeTheWorld) {
  const auto hash = [](const std::string& lines) {
    return parse_scene_file("[[device]]\n" + lines + kOperator, "x.toml").hash;
  };
  EXPECT_EQ(hash("driver = \"falcon\"\n"), hash(""));
}

// Whatever rate is accepted: one period missed and the next one late by half of one.
TEST(DeviceSection, TheSlowestServoMayMissAPeriodAndTheDeviceHoldsItsForce) {
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

TEST(DeviceSection, SaysTheDefaultsOfItsStruct) {
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
  EXPECT_EQ(silent.region_loan, standard.region_loan);
  EXPECT_EQ(silent.oscillation_power, standard.oscillation_power);
  EXPECT_EQ(silent.oscillation_energy, standard.oscillation_energy);
  EXPECT_EQ(silent.resolution, standard.resolution);
  EXPECT_EQ(silent.axes, standard.axes);
  EXPECT_EQ(silent.turn_damping, standard.turn_damping);
  EXPECT_EQ(silent.max_torque, standard.max_torque);
  EXPECT_EQ(silent.turn_resolution, standard.turn_resolution);
  EXPECT_EQ(silent.period, standard.period);
  EXPECT_EQ(silent.delay_samples, standard.delay_samples);
  EXPECT_EQ(silent.source, standard.source);
  EXPECT_EQ(silent.driver, standard.driver);
  EXPECT_EQ(silent.firmware, standard.firmware);
  EXPECT_EQ(silent.upper_weight, standard.upper_weight);
  EXPECT_EQ(silent.fore_weight, standard.fore_weight);
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

TEST(DeviceSection, TurnsItsAxesFromThoseOfTheScene) {
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

TEST(DeviceSection, RefusesWhatCannotBeMeant) {
  const std::pair<std::string, const char*> cases[] = {
      {"operator = 2\n",
       "x.toml:2:12: there is no [[operator]] 2: the file has 1; name one of them or add one"},
      {"rate = \"249 Hz\"\n", "x.toml:2:8: 'rate' is 249 Hz; it must be 250 Hz to 10 kHz"},
      {"rate = \"10.1 kHz\"\n", "it must be 250 Hz to 10 kHz"},
      {"delay = \"101 ms\"\n", "x.toml:2:9: 'delay' is 101 ms; it must be 0 s to 100 ms"},
      {"delay = \"-1 ms\"\n", "it must be"},
      {"rate = nan\n", "it must be"},
      {"max_force = 0\n", "it must be"},
      {"marking = \"TWELVE CHARS\"\n", "at most 11 fit"},
      {"heading = 0\norientation = [0, 0, 0]\n", "x.toml:3:15: it is turned twice"},
      {"peer = 65\n", "it must be 1 to 64"},
      {"kind = \"mouse\"\n", "it wants one of simulated pointer"},
      {"kind = \"pointer\"\nreach = 0\n", "x.toml:3:9: 'reach' is 0 m; it must be 1 mm to 10 m"},
      {"reach = 0.1\n", "x.toml:2:9: only a pointer has a reach: add kind = \"pointer\""},
  };
  for (const auto& [lines, words] : cases) {
    EXPECT_THAT(refusal("[[device]]\n" + lines + kOperator), HasSubstr(words)) << lines;
  }
  EXPECT_THAT(refusal("[[device]]\n"),
              HasSubstr("x.toml:1:1: there is no [[operator]] 1: the file has 0;"));
}

}  // namespace
}  // namespace reckon::peer
