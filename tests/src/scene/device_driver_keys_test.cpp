// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The keys of [[device]] that depend on its driver.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/drivers/evdev.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer::device_driver_keys_test {
namespace {

using test::refusal;
using testing::HasSubstr;

constexpr const char* kOperator = "[[operator]]\npassive = true\n";

DeviceConfig device_of(const std::string& lines) {
  return parse_scene_file("[[device]]\n" + lines + kOperator, "x.toml").devices.at(0);
}

// Each of these lines is refused with this text.
void expect_refused(const std::vector<std::pair<std::string, std::string>>& cases) {
  for (const auto& [lines, words] : cases)
    EXPECT_THAT(refusal("[[device]]\n" + lines + kOperator), HasSubstr(words)) << lines;
}

// The driver supplies the limits that the file does not state.
TEST(DeviceSection, NamesAFalconAndTakesItsLimits) {
  EXPECT_EQ(driver_name(device_of("driver = \"simulated\"\n")), "simulated");
  const DeviceConfig plain = device_of("driver = \"falcon\"\n");
  EXPECT_EQ(driver_name(plain), "falcon");
  EXPECT_EQ(plain.max_force, 8.9);
  EXPECT_EQ(plain.delay_samples, 6);
  // The assumed damping holds at the centre, less a tenth; elsewhere the damping of the joints
  // counts.
  EXPECT_NEAR(plain.damping, 0.9 * 0.3, 3e-4);
  EXPECT_NEAR(plain.joint_damping, haptics::falcon_facts().joints_per_damping * 0.3, 1e-12);
  EXPECT_EQ(plain.resolution, 90e-6);

  const DeviceConfig known = device_of(
      "driver = \"falcon\"\ndamping = \"2 N s/m\"\ndelay = \"3.5 ms\"\nmax_force = \"5 N\"\n");
  EXPECT_EQ(known.delay_samples, 4);
  EXPECT_NEAR(known.damping, 1.8, 1e-12);
  EXPECT_EQ(known.max_force, 5);
  // Its device has the same limits.
  const haptics::DeviceLimits limits =
      haptics::usb_limits(haptics::falcon_facts(), usb_settings_of(known));
  EXPECT_EQ(limits.delay_samples, 4);
  EXPECT_NEAR(limits.damping, 1.8, 1e-12);
}

TEST(DeviceSection, RefusesKeysThatContradictAFalcon) {
  const std::string falcon = "driver = \"falcon\"\n";
  expect_refused({{"driver = \"falkon\"\n", "did you mean \"falcon\"?"},
                  {falcon + "kind = \"pointer\"\n", "so a pointer cannot"},
                  {falcon + "resolution = \"10 um\"\n", "sets the resolution"},
                  {falcon + "rate = \"300 Hz\"\n", "write 400 Hz or more"},
                  {falcon + "firmware = \"no_such_file\"\n", "no_such_file"},
                  {"firmware = \"no_such_file\"\n", "only a Falcon has this key"}});
}

TEST(DeviceSection, APluginIsNamedByItsFile) {
  const std::string plugin = "driver = \"plugin\"\n";
  expect_refused({{plugin, "add plugin = \"driver.so\""},
                  {plugin + "plugin = \"drivers/\"\n", "add plugin = \"driver.so\""},
                  {"plugin_options = \"x\"\n", "add driver = \"plugin\""}});
  EXPECT_EQ(refusal("[[device]]\n" + plugin + "plugin = \"no_such.so\"\n" + kOperator), "")
      << "it is not opened";
}

constexpr const char* kWheel =
    "driver = \"evdev\"\ntravel = \"0.2 m\"\nfull_force = \"20 N\"\nfull_stiffness = \"2 kN/m\"\n"
    "max_stiffness = \"1.5 kN/m\"\n";

TEST(DeviceSection, EventDeviceTakesItsKeys) {
  const DeviceConfig plain = device_of(kWheel);
  EXPECT_EQ(driver_name(plain), "evdev");
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

TEST(DeviceSection, RefusesAnEventDeviceWithMissingKeys) {
  const std::string whole = kWheel;
  for (const std::string key : {"travel", "full_force", "full_stiffness", "max_stiffness"}) {
    const std::size_t from = whole.find(key);
    expect_refused({{std::string(whole).erase(from, whole.find('\n', from) + 1 - from),
                     "write '" + key + "'"}});
  }
  expect_refused({{whole + "scale = 2\n", "remove 'scale'"},
                  {whole + "axes = 6\n", "remove 'axes'"},
                  {whole + "kind = \"pointer\"\n", "so a pointer cannot"},
                  {"driver = \"falcon\"\ntravel = \"0.2 m\"\n", "add driver = \"evdev\""}});
}

TEST(DeviceSection, NamesAPolhemAndTakesItsLimits) {
  const DeviceConfig plain = device_of("driver = \"polhem\"\n");
  EXPECT_EQ(driver_name(plain), "polhem");
  EXPECT_EQ(plain.max_force, 5.0);
  EXPECT_EQ(plain.delay_samples, 6);
  const double lever = haptics::polhem_facts().lever;
  EXPECT_NEAR(plain.damping,
              0.9 * haptics::polhem_facts().joints_per_damping * 0.2 / (lever * lever), 1e-12)
      << "assumed";
  EXPECT_EQ(plain.resolution, 95e-6);

  // Gravity compensation costs damping: the slope of the torque, one exchange late, at 50 mm.
  const DeviceConfig held = device_of(
      "driver = \"polhem\"\ndamping = \"2 N s/m\"\nupper_weight = \"0.17 N m\"\n"
      "fore_weight = \"0.055 N m\"\n");
  EXPECT_NEAR(held.damping, 1.8 - 0.17 * 0.002 / (0.05 * 0.05), 1e-12);
  EXPECT_EQ(driver_value<double>(held, "upper_weight"), 0.17);
  EXPECT_EQ(driver_value<double>(held, "fore_weight"), 0.055);
  // Its device has the same limits.
  const haptics::DeviceLimits limits =
      haptics::usb_limits(haptics::polhem_facts(), usb_settings_of(held));
  EXPECT_NEAR(limits.damping, held.damping, 1e-12);
}

TEST(DeviceSection, JointFrictionReplacesThatOfTheHandle) {
  for (const auto& [name, facts] :
       {std::pair("falcon", &haptics::falcon_facts()), {"polhem", &haptics::polhem_facts()}}) {
    const DeviceConfig device =
        device_of("driver = \"" + std::string(name) + "\"\njoint_damping = \"0.02 N m s/rad\"\n");
    const double square = facts->lever * facts->lever;
    EXPECT_NEAR(device.damping, 0.9 * 0.02 / square, 1e-9) << name;
    // Its device has the same limits.
    const haptics::DeviceLimits limits = haptics::usb_limits(*facts, usb_settings_of(device));
    EXPECT_NEAR(limits.damping, device.damping, 1e-12) << name;
    EXPECT_EQ(limits.lever, facts->lever) << name;
  }
  EXPECT_EQ(haptics::usb_limits(haptics::falcon_facts(),
                                usb_settings_of(device_of("driver = \"falcon\"\ndamping = 1\n")))
                .lever,
            0.0)
      << "of the handle where that is said";
  // Gravity compensation costs the slope of the torque, one exchange late, in every pose.
  const DeviceConfig held = device_of(
      "driver = \"polhem\"\njoint_damping = \"0.02 N m s/rad\"\nupper_weight = \"0.17 N m\"\n");
  const double lever = haptics::polhem_facts().lever;
  EXPECT_NEAR(held.damping, (0.9 * 0.02 - 0.17 * 0.002) / (lever * lever), 1e-9);
  const std::string joints = "joint_damping = \"0.02 N m s/rad\"\n";
  expect_refused(
      {{joints, "its driver does not know the joints"},
       {"driver = \"falcon\"\ndamping = \"1 N s/m\"\n" + joints, "both give the friction"}});
}

TEST(DeviceSection, RefusesKeysThatContradictAPolhem) {
  const std::string polhem = "driver = \"polhem\"\n";
  expect_refused(
      {{polhem + "axes = 6\n", "a Polhem has three axes"},
       {polhem + "rate = \"300 Hz\"\n", "a Polhem drops its force"},
       {polhem + "kind = \"pointer\"\n", "a person moves a Polhem"},
       {polhem + "firmware = \"x.bin\"\n", "only a Falcon has this key"},
       {polhem + "damping = 0.2\nupper_weight = \"0.5 N m\"\n", "uses 0.4 N s/m of damping"},
       {polhem + "joint_damping = 0.001\nupper_weight = \"0.5 N m\"\n",
        "uses 0.001 N m s/rad of joint_damping"},
       {"upper_weight = \"0.1 N m\"\n", "only a Polhem has this key"},
       {"fore_weight = \"0.1 N m\"\n", "only a Polhem has this key"}});
}

TEST(DeviceSection, GivesASerialBoardItsLimits) {
  const DeviceConfig plain = device_of("driver = \"serial\"\nport = \"/dev/ttyACM0\"\n");
  EXPECT_EQ(driver_name(plain), "serial");
  EXPECT_EQ(driver_value<std::string>(plain, "port"), "/dev/ttyACM0");
  EXPECT_EQ(driver_value<std::uint32_t>(plain, "baud"), 1'000'000U);
  EXPECT_EQ(plain.max_force, 1.0) << "assumed";
  EXPECT_NEAR(plain.damping, 0.9 * 0.1, 1e-12) << "assumed, less a tenth";
  EXPECT_EQ(plain.resolution, 100e-6) << "assumed";
  EXPECT_EQ(plain.delay_samples, 6);

  const DeviceConfig known = device_of(
      "driver = \"serial\"\nport = \"/dev/ttyUSB0\"\nbaud = 115200\nmax_force = \"3 N\"\n"
      "resolution = \"14.7 um\"\ndamping = \"2 N s/m\"\ndelay = \"3.5 ms\"\n");
  EXPECT_EQ(driver_value<std::uint32_t>(known, "baud"), 115'200U);
  EXPECT_EQ(known.max_force, 3.0);
  EXPECT_NEAR(known.resolution, 14.7e-6, 1e-18);
  EXPECT_NEAR(known.damping, 1.8, 1e-12);
  EXPECT_EQ(known.delay_samples, 4);
  // Its device has the same limits.
  const haptics::DeviceLimits limits =
      haptics::usb_limits(haptics::serial_facts(), usb_settings_of(known));
  EXPECT_EQ(limits.max_force, known.max_force);
  EXPECT_EQ(limits.resolution, known.resolution);
  EXPECT_NEAR(limits.damping, 1.8, 1e-12);
  EXPECT_EQ(limits.delay_samples, 4);
}

TEST(DeviceSection, RefusesKeysThatContradictASerialBoard) {
  const std::string serial = "driver = \"serial\"\n";
  const std::string wired = serial + "port = \"/dev/ttyACM0\"\n";
  expect_refused({{serial, "add port = \"/dev/ttyACM0\""},
                  {wired + "axes = 6\n", "remove axes = 6"},
                  {wired + "rate = \"300 Hz\"\n", "after 6.5 ms"},
                  {wired + "kind = \"pointer\"\n", "a person moves a serial board"},
                  {"port = \"/dev/ttyACM0\"\n", "only a serial board has this key"},
                  {"baud = 9600\n", "only a serial board has this key"}});
}

// Each host chooses its own device driver.
TEST(DeviceSection, ADriverDoesNotChangeTheWorld) {
  const auto hash = [](const std::string& lines) {
    return parse_scene_file("[[device]]\n" + lines + kOperator, "x.toml").hash;
  };
  EXPECT_EQ(hash("driver = \"falcon\"\n"), hash(""));
}

}  // namespace
}  // namespace reckon::peer::device_driver_keys_test
